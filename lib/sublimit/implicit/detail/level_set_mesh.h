// SPDX-License-Identifier: Apache-2.0
#pragma once
// A control mesh whose limit is a level set: polygonise on a coarse grid, make a cage of it, fit its limit, and split
// faces until the limit is as near as asked for.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/implicit/detail/closed_mesh.h"
#include "sublimit/implicit/detail/field_grid.h"
#include "sublimit/implicit/detail/level_set_fit.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Polygons around {F < 0} of a sampled field: `polygonize`, or a program's own.
using Polygonizer = std::function<Mesh(const FieldGrid&)>;

struct LevelSetOptions {
  std::optional<Eigen::AlignedBox3d> box = std::nullopt;  ///< absent: the field's extent, with a cell of air
  int cells = 0;  ///< along the longest side of the box; 0: as few as show the shape, 5 to 64
  /// For the largest distance; 0: 1e-4 of the diagonal of the box, or of the surface's own if none is given.
  double tolerance = 0;
  int rounds = 6;  ///< of fitting
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
  std::vector<LevelSetAttempt> attempts;  ///< all of them
  double tolerance = 0, diagonal = 0;     ///< of the surface's bounding box
  double cell = 0;                        ///< side of the grid's cubes
  double least = 0, largest = 0;          ///< values of the field on the grid
  ClosedMeshCounts counts;
  std::optional<ClosedMeshCounts> fine_counts;  ///< with twice as many cells; absent: the notes say why
  std::vector<std::string> notes;               ///< remarks for the user
  /// True if the limit is within the tolerance, and no face is folded.
  bool met() const { return attempt.met(tolerance); }
};

/// @return  the first cage that meets the tolerance, or the nearest one of those that were tried
/// @throws InvalidParameter, ResourceError  as padded_extent and sample_field; a tolerance that is negative
/// @throws InvalidMesh  the surface nearly touches itself and polygons are no manifold
LevelSetMesh level_set_mesh(const FieldPointer& field, const Scheme<double>& scheme, const Polygonizer& polygonize,
                            const LevelSetOptions& options = {});

}  // namespace sublimit
