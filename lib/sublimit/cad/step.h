// SPDX-License-Identifier: Apache-2.0
#pragma once
// Writes limit surfaces and patches to files that CAD programs read, by OpenCASCADE: link sublimit::cad.
//
//   const StepFile written = step(LimitSurface(mesh, "catmull-clark"), "surface.step");
//   if (!written.met) std::cerr << "caps are off by " << written.deviation << "\n";
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "sublimit/patches/patches.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit {

/// How two faces of a file meet: at the same points (g0), or with the same tangent planes too (g1).
enum class StepJoin { g0, g1 };

/// Unit of length of coordinates, written into STEP files; numbers stay as they are.
enum class LengthUnit { mm, m, inch };

/// How `step` approximates and names faces. For patches only `tolerance` matters.
struct StepOptions {
  /// Largest distance, a length > 0. For limit surfaces: of the caps around extraordinary vertices from the limit;
  /// 1e-5 of the diagonal of the control points if absent. For patches: between sides that become one edge; 1e-9 of
  /// the diagonal if absent.
  std::optional<double> tolerance = {};
  StepJoin join = StepJoin::g0;      ///< how caps meet their neighbours; g1 under schemes of quadrilaterals alone
  bool pack = true;                  ///< regular faces as the largest B-splines that keep knots and smoothness
  LengthUnit unit = LengthUnit::mm;  ///< of STEP; a .brep has none
  Mesh::FaceNames face_names = {};   ///< STEP names of the mesh's faces; faces of different names are not packed
  /// Values of the mesh's faces, as `Mesh::face_values`: red, green and blue are their colours in STEP. Faces of
  /// different colours are not packed.
  std::vector<Mesh::Values> face_values = {};
};

/// Statistics of a file that `step` wrote.
struct [[nodiscard]] StepFile {
  int solids = 0, shells = 0;  ///< closed and open parts
  std::int64_t faces = 0;      ///< faces in the file
  std::int64_t caps = 0;       ///< faces around extraordinary vertices, before packing
  double deviation = 0;        ///< measured distance of caps from the limit
  bool met = true;             ///< true if the deviation is within the tolerance
  bool is_valid = false;       ///< result of OpenCASCADE's own check
};

/// Writes a limit surface as exact B-spline faces with shared edges, solids where it is closed; holes are left out.
/// @param path  .step, .stp or .brep
/// @throws InvalidOption        another extension
/// @throws InvalidParameter     a tolerance that is not positive, names or colours that are not one for each face
/// @throws InvalidMesh          no faces, or no extent
/// @throws UnsupportedTopology  a scheme without polynomials
/// @throws IoError              a file that cannot be written
/// @throws ResourceError        more faces than a file may have, a full disk
StepFile step(const LimitSurface& surface, const std::filesystem::path& path, const StepOptions& options = {});
/// Writes classical patches, a face for each.
/// @param path  .step, .stp or .brep
/// @throws UnsupportedTopology  a patch that is no B-spline: says which and why
/// @throws InvalidOption, InvalidParameter, InvalidMesh, IoError, ResourceError  as for limit surfaces
StepFile step(const Patches& patches, const std::filesystem::path& path, const StepOptions& options = {});

}  // namespace sublimit
