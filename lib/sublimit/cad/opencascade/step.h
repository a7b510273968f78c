// SPDX-License-Identifier: Apache-2.0
#pragma once
// Writes limit surfaces and patches to files that CAD programs read, by OpenCASCADE: link sublimit::cad.
//
//   const StepFile written = step(LimitSurface(mesh, "catmull-clark"), "surface.step");
//   if (!written.met) std::cerr << "caps are off by " << written.deviation << "\n";
#include <filesystem>

#include "sublimit/cad/step_options.h"
#include "sublimit/patches/patches.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit {

/// Writes a limit surface as exact B-spline faces with shared edges, solids where it is closed; holes are left out.
/// @param path  .step, .stp or .brep
/// @throws InvalidOption        another extension
/// @throws InvalidParameter     a tolerance that is not positive, names that are not one for each face
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
