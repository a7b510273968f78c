// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control meshes whose limit is a level set: polygonise on a coarse grid, make a cage, fit its limit, and split
// faces until the limit is within a tolerance.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/implicit/detail/closed_mesh.h"
#include "sublimit/implicit/detail/field_grid.h"
#include "sublimit/implicit/detail/level_set_fit.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Function that returns polygons around {F < 0} of a sampled field: `polygonize`, or one of the caller.
using Polygonizer = std::function<Mesh(const FieldGrid&)>;

struct LevelSetOptions {
  std::optional<Eigen::AlignedBox3d> box = std::nullopt;  ///< absent: the field's extent plus a cell
  int cells = 0;  ///< cells along the longest side of the box; 0: as few as capture the shape, 5 to 64
  /// Tolerance of the largest distance; 0: 1e-4 of the diagonal of `box`, or of the surface's bounding box
  /// without one.
  double tolerance = 0;
  int rounds = 6;  ///< rounds of fitting
  Index most_faces = 20'000;
  std::function<void(const std::string&)> progress = {};
};

/// A cage and the statistics of its fit.
struct LevelSetAttempt {
  int cells = 0, splits = 0;
  Index faces = 0;
  LevelSetError error;
  bool met(double tolerance) const { return error.largest <= tolerance && !error.is_folded(); }
};

struct [[nodiscard]] LevelSetMesh {
  Mesh cage;  ///< a closed manifold, with tags where the field has sharp edges
  LevelSetAttempt attempt;
  std::vector<LevelSetAttempt> attempts;  ///< all attempts
  double tolerance = 0, diagonal = 0;     ///< tolerance, and diagonal of the surface's bounding box
  double cell = 0;                        ///< side of the grid's cubes
  double least = 0, largest = 0;          ///< values of the field on the grid
  ClosedMeshCounts counts;
  std::optional<ClosedMeshCounts> fine_counts;  ///< topology with twice as many cells; absent: notes say why
  std::vector<std::string> notes;               ///< remarks for the user
  /// True if the limit is within the tolerance, and no face is folded.
  bool met() const { return attempt.met(tolerance); }
};

/// Returns a control mesh of a level set.
/// @return  the first cage that meets the tolerance, or else the best one of all attempts
/// @throws InvalidParameter, ResourceError  see padded_extent and sample_field; a negative tolerance
/// @throws InvalidMesh  the surface nearly touches itself, so that polygons are no manifold
LevelSetMesh level_set_mesh(const FieldPointer& field, const Scheme<double>& scheme, const Polygonizer& polygonize,
                            const LevelSetOptions& options = {});

}  // namespace sublimit
