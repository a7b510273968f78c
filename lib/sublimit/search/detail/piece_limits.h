// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits on a grid over a piece without a polynomial, for ray tracing. Rows are computed once per type and
// shared by threads.
#include <array>
#include <memory>
#include <shared_mutex>
#include <unordered_map>

#include "sublimit/nets/piece_parts.h"

namespace sublimit {

/// A regular grid of places of a piece, including its sides; ordered by v, then by u.
struct PieceGrid {
  static constexpr int steps = 4;
  bool triangle = false;

  int width(int j) const { return triangle ? steps - j : steps; }
  Eigen::Index size() const { return triangle ? (steps + 1) * (steps + 2) / 2 : (steps + 1) * (steps + 1); }
  Eigen::Index row(int i, int j) const {
    return triangle ? j * (steps + 1) - j * (j - 1) / 2 + i : j * (steps + 1) + i;
  }
  /// Returns the rows of the corners, counter-clockwise. The last one of triangles is unused.
  std::array<Eigen::Index, 4> corners() const {
    return triangle ? std::array<Eigen::Index, 4>{row(0, 0), row(steps, 0), row(0, steps), 0}
                    : std::array<Eigen::Index, 4>{row(0, 0), row(steps, 0), row(steps, steps), row(0, steps)};
  }
};

/// Cache of the rows of limits, by type.
class PieceLimits {
 public:
  /// Returns the limits of a piece at the places of its grid; no rows if one of them diverges.
  /// @param points  points of the piece, by slot
  Points at(const PieceType& type, const Points& points) const;

 private:
  const RowMatrix& rows(const PieceType& type) const;
  mutable std::shared_mutex mutex_;
  mutable std::unordered_map<const PieceType*, std::unique_ptr<const RowMatrix>> rows_;
};

}  // namespace sublimit
