// SPDX-License-Identifier: Apache-2.0
#pragma once
// Patches as a boundary representation: a face for each, and edges shared where sides are one curve in one parameter
// (patch_seams.h), a side with another or with the opposite one of its own patch. Where sides lie on parts of others
// they are cut into several edges at the corners there (side_cuts.h). Sides that are a point are edges without a curve.
// Where two have one shape in different parameters, where three or more meet, each has an edge of its own. Fronts of
// faces that share edges are on one side, unless the surface has one side only: it is left open then.
#include "sublimit/cad/boundary_model.h"
#include "sublimit/cad/clamped_patches.h"

namespace sublimit {

struct PatchModelOptions {
  double same = 1e-9;  ///< sides and corners as near as that, relative to the diagonal of all control points, are one
};

struct PatchModel {
  BoundaryModel boundary;
  double diagonal = 0;                  ///< of all control points
  std::int64_t shared = 0, seams = 0;   ///< edges of two faces; of one, twice
  std::int64_t points = 0;              ///< sides that are a point
  std::int64_t open = 0;                ///< sides without a partner
  std::int64_t partial = 0;             ///< pairs of sides with a part in common, in different parameters
  std::int64_t reparametrised = 0;      ///< pairs of sides with one shape in different parameters
  std::int64_t non_manifold = 0;        ///< curves that are three sides or more
  std::int64_t unsuitable = 0;          ///< pairs that would leave no two sides, or fold a face onto itself
  double gap = 0;                       ///< largest between shared sides
  double angle = 0;                     ///< largest between normals across them, radians
  std::array<double, 3> angle_at = {};  ///< where
  double area = 0;
};

/// @throws UnsupportedTopology  as `clamped_patches`; a patch without area
/// @throws InvalidParameter     columns of another size, or not finite; no patches
PatchModel patch_model(std::span<const NamedPatch> patches, const PatchModelOptions& options = {});

}  // namespace sublimit
