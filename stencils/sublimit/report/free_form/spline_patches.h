// SPDX-License-Identifier: Apache-2.0
#pragma once
// The surfaces of a file as B-splines, between which seams are searched. A surface in another basis becomes the
// net of its Bezier pieces; a part of a surface gets knots that end where the part ends.
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
  /// For each patch: true if its net is computed from that of the file and so rounded, which rules out exact
  /// verdicts.
  std::vector<bool> is_converted;
};

/// Returns the surfaces of a file as B-splines.
/// @param name  name of the file, for messages
/// @throws UnsupportedTopology, InvalidParameter  as free_form_patches
SplinePatches spline_patches(const FreeForm& shapes, const std::string& name);

}  // namespace sublimit
