// SPDX-License-Identifier: Apache-2.0
#pragma once
// A baked table of stencils: rows of weights over control points, applied every frame. Knows no scheme and no mesh;
// plain arrays in, plain arrays out.
#include <cstdint>
#include <span>

#include "sublimit/shared_array.h"

namespace sublimit {

/// Rows of a sparse matrix with 64-bit offsets and 32-bit columns.
template <class Real>
class StencilTable {
 public:
  StencilTable() = default;

  /// @param num_control_points  points that the table is applied to
  /// @param offsets  #rows + 1, ascending from 0: row i holds entries offsets[i] .. offsets[i+1]-1
  /// @param columns  control point of each entry
  /// @param weights  weight of each entry, finite
  /// @throws InvalidParameter  arrays that do not fit together, a column out of range, a weight that is not finite
  StencilTable(std::int32_t num_control_points, SharedArray<std::int64_t> offsets, SharedArray<std::int32_t> columns,
               SharedArray<Real> weights);

  std::int64_t num_rows() const { return offsets_.empty() ? 0 : static_cast<std::int64_t>(offsets_.size()) - 1; }
  std::int32_t num_control_points() const { return num_control_points_; }
  const SharedArray<std::int64_t>& offsets() const { return offsets_; }
  const SharedArray<std::int32_t>& columns() const { return columns_; }
  const SharedArray<Real>& weights() const { return weights_; }
  std::int64_t num_bytes() const { return offsets_.num_bytes() + columns_.num_bytes() + weights_.num_bytes(); }

  /// new points = table * control points, in parallel, the same bits for any number of threads.
  /// @param points    num_control_points x channels, interleaved
  /// @param result    num_rows x channels, interleaved; must not overlap `points`
  /// @throws InvalidParameter  spans of the wrong length, channels < 1
  void apply(std::span<const Real> points, int channels, std::span<Real> result) const;

  /// The same for rows [begin, end), on this thread, without a check.
  /// @param result  (end - begin) x channels
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
