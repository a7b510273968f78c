// SPDX-License-Identifier: Apache-2.0
#pragma once
// Patches as boundary representations, with a face for each patch. Sides that are the same curve in the same
// parameter (patch_seams.h) share an edge; they may be opposite sides of one patch. Sides with parts on other
// sides are cut into several edges at the corners there (side_cuts.h). Collapsed sides are edges without a
// curve. Sides of the same shape in different parameters, and three or more sides that meet, have separate
// edges. Faces that share edges are oriented consistently; a one-sided surface is left open.
#include "sublimit/cad/boundary_model.h"
#include "sublimit/cad/clamped_patches.h"

namespace sublimit {

/// Options of `patch_model`.
struct PatchModelOptions {
  /// Distance up to which sides and corners count as the same, relative to the diagonal of all control points.
  double same = 1e-9;
};

/// A model with its statistics.
struct PatchModel {
  BoundaryModel boundary;
  double diagonal = 0;                  ///< diagonal of all control points
  std::int64_t shared = 0, seams = 0;   ///< number of edges of two faces, and of edges twice on one face
  std::int64_t points = 0;              ///< number of collapsed sides
  std::int64_t open = 0;                ///< number of sides without a partner
  std::int64_t partial = 0;             ///< pairs of sides with a common part, in different parameters
  std::int64_t reparametrised = 0;      ///< pairs of sides of the same shape in different parameters
  std::int64_t non_manifold = 0;        ///< number of curves with three or more sides
  std::int64_t unsuitable = 0;          ///< pairs whose edge would make a one-sided surface or fold a face onto itself
  double gap = 0;                       ///< largest gap between shared sides
  double angle = 0;                     ///< largest angle between normals across shared sides, radians
  std::array<double, 3> angle_at = {};  ///< place of the largest angle
  double area = 0;
};

/// Returns the model of patches.
/// @throws UnsupportedTopology  see `clamped_patches`; a patch without area
/// @throws InvalidParameter     columns of another size, or not finite; no patches
PatchModel patch_model(std::span<const NamedPatch> patches, const PatchModelOptions& options = {});

}  // namespace sublimit
