// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table of stencils: rows of weights over control points, in plain arrays, independent of schemes and meshes:
//
//   // The middle of an edge from point 0 to point 1, and point 2.
//   const StencilTable<float> table(3, {0, 2, 3}, {0, 1, 2}, {0.5F, 0.5F, 1.0F});
//   std::vector<float> result(3 * table.num_rows());
//   table.apply(points, 3, result);  // points: std::vector<float> of 3 x 3 numbers, x y z of each
#include <cstdint>
#include <span>

#include "sublimit/eval/table/shared_array.h"

namespace sublimit {

/// Rows of a sparse matrix with 64-bit offsets and 32-bit columns. Constant once made: any number of threads may share
/// it, and copies share the arrays.
template <class Real>
class StencilTable {
 public:
  /// Makes a table without rows.
  StencilTable() = default;

  /// Makes a table of arrays.
  /// @param num_control_points  points that the table is applied to
  /// @param offsets  #rows + 1, ascending from 0: row i holds entries offsets[i] .. offsets[i+1]-1
  /// @param columns  control point of each entry
  /// @param weights  weight of each entry, finite
  /// @throws InvalidParameter  arrays that do not fit together, a column out of range, a weight that is not finite
  StencilTable(std::int32_t num_control_points, SharedArray<std::int64_t> offsets, SharedArray<std::int32_t> columns,
               SharedArray<Real> weights);

  /// Returns the number of points that the table makes.
  std::int64_t num_rows() const { return offsets_.empty() ? 0 : static_cast<std::int64_t>(offsets_.size()) - 1; }
  /// Returns the number of points that the table is applied to.
  std::int32_t num_control_points() const { return num_control_points_; }
  const SharedArray<std::int64_t>& offsets() const { return offsets_; }
  const SharedArray<std::int32_t>& columns() const { return columns_; }
  const SharedArray<Real>& weights() const { return weights_; }
  /// Returns the size of all arrays in bytes.
  std::int64_t num_bytes() const { return offsets_.num_bytes() + columns_.num_bytes() + weights_.num_bytes(); }

  /// Makes new points = table * control points, in parallel; the same bits for any number of threads.
  /// @param points    num_control_points x channels, interleaved
  /// @param result    num_rows x channels, interleaved; must not overlap `points`
  /// @throws InvalidParameter  spans of the wrong length, channels < 1
  void apply(std::span<const Real> points, int channels, std::span<Real> result) const;

  /// Makes the points of rows [begin, end) on the calling thread. Arguments are not checked.
  /// @param points  num_control_points x channels, interleaved
  /// @param result  (end - begin) x channels, interleaved
  void apply_rows(const Real* points, int channels, std::int64_t begin, std::int64_t end, Real* result) const;

 private:
  std::int32_t num_control_points_ = 0;
  SharedArray<std::int64_t> offsets_;
  SharedArray<std::int32_t> columns_;
  SharedArray<Real> weights_;
};

extern template class StencilTable<float>;
extern template class StencilTable<double>;

}  // namespace sublimit
