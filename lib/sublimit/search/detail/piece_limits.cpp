// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/piece_rows.h"
#include "sublimit/search/detail/piece_limits.h"

#include <mutex>
#include <utility>

namespace sublimit {

Points PieceLimits::at(const PieceType& type, const Points& points) const {
  const RowMatrix& known = rows(type);
  if (known.rows() == 0) return Points(0, 3);
  const Points differences = points.bottomRows(points.rows() - 1).rowwise() - points.row(0);
  return (known * differences).rowwise() + points.row(0);
}

const RowMatrix& PieceLimits::rows(const PieceType& type) const {
  {
    const std::shared_lock lock(mutex_);
    if (const auto at = rows_.find(&type); at != rows_.end()) return *at->second;
  }
  // Made without the lock: others may make the same rows, and one of them are kept.
  const PieceGrid grid{type.kind() == Piece::Kind::triangle};
  auto made = std::make_unique<RowMatrix>(grid.size(), type.num_slots() - 1);
  for (int j = 0; j <= PieceGrid::steps; ++j)
    for (int i = 0; i <= grid.width(j); ++i) {
      const double u = double(i) / PieceGrid::steps, v = double(j) / PieceGrid::steps;
      made->row(grid.row(i, j)) =
          piece_rows(type, grid.triangle ? triangle_place(u, v) : quad_place(u, v), 0).rows.row(0);
    }
  if (!made->allFinite()) made->resize(0, 0);
  const std::unique_lock lock(mutex_);
  return *rows_.try_emplace(&type, std::move(made)).first->second;
}

}  // namespace sublimit
