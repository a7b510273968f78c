// SPDX-License-Identifier: Apache-2.0
#pragma once
// The surfaces of a file as B-splines, in which seams are looked for: a surface of another basis is the net of its
// Bezier pieces, a part of a surface has knots of its own that end where it ends.
#include <memory>
#include <string>
#include <vector>

#include "sublimit/io/free_form.h"
#include "sublimit/patches/joins/seam_strips.h"

namespace sublimit {

struct SplinePatches {
  std::vector<std::shared_ptr<const SplineSurface>> surfaces;
  std::vector<PatchColumns> patches;  ///< one for each surface of the file, in its order; they refer to `surfaces`
  Coordinates coordinates = Coordinates::plain;
  /// True for each patch whose net is computed from that of the file: exact verdicts would be on rounded numbers.
  std::vector<bool> is_converted;
};

/// @param name  of the file, for messages
/// @throws UnsupportedTopology, InvalidParameter  as free_form_patches
SplinePatches spline_patches(const FreeForm& shapes, const std::string& name);

}  // namespace sublimit
