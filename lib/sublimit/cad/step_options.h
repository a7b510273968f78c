// SPDX-License-Identifier: Apache-2.0
#pragma once
// What `step` (opencascade/step.h) is asked for, and what it says of the file it wrote.
#include <cstdint>
#include <optional>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// How two faces of a file meet: at the same points (g0), or with the same tangent planes too (g1).
enum class StepJoin { g0, g1 };

/// How `step` approximates and names faces. For patches only `tolerance` matters.
struct StepOptions {
  /// Largest distance, a length > 0. For limit surfaces: of the caps around extraordinary vertices from the limit;
  /// 1e-5 of the diagonal of the control points if absent. For patches: between sides that become one edge; 1e-9 of
  /// the diagonal if absent.
  std::optional<double> tolerance = {};
  StepJoin join = StepJoin::g0;     ///< how caps meet their neighbours; g1 under schemes of quadrilaterals alone
  bool pack = true;                 ///< regular faces as the largest B-splines that keep knots and smoothness
  Mesh::FaceNames face_names = {};  ///< STEP names of the mesh's faces; faces of different names are not packed
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

}  // namespace sublimit
