// SPDX-License-Identifier: Apache-2.0
#pragma once
// Free-form surfaces of a file as patches with their control points.
#include <string>
#include <vector>

#include "sublimit/io/free_form.h"
#include "sublimit/patches/patch_set.h"

namespace sublimit {

/// Patches, the columns of their control points, and what each was in the file.
struct FreeFormPatches {
  PatchSet patches;
  Points columns;                  ///< x 3, or x 4, homogeneous, if one of them is rational
  std::vector<std::int64_t> line;  ///< of each patch
};

/// The surfaces of a file: Bezier surfaces of several pieces have knots of full multiplicity, Catmull-Rom and basis
/// matrices become Bezier pieces, which they are.
/// @throws UnsupportedTopology  no surfaces
/// @throws InvalidParameter     knots that make no B-spline, with the line
FreeFormPatches free_form_patches(const FreeForm& shapes, const std::string& name);

}  // namespace sublimit
