// SPDX-License-Identifier: Apache-2.0
#pragma once
// The transpose of a table by patterns: first contributions of each patch to its control points, then their sum for
// each control point, in the order of patches.
#include <memory>
#include <span>

#include "sublimit/base/detail/buffer_pool.h"
#include "sublimit/base/detail/found_once.h"
#include "sublimit/eval/table/pattern_table.h"

namespace sublimit {

/// The transpose of a table. Any number of threads may use it at once.
template <class Real>
class PatternTranspose {
 public:
  /// @param table  must outlive this
  explicit PatternTranspose(const PatternTable<Real>& table);
  explicit PatternTranspose(const PatternTable<Real>&&) = delete;
  ~PatternTranspose();
  PatternTranspose(PatternTranspose&&) noexcept;

  /// Applies the transpose, as `PatternEvaluator::apply_transpose`.
  /// @param contract  fuse products and sums
  void apply(std::span<const Real> values, int channels, std::span<Real> result, bool contract,
             BufferPool<Real>& buffers) const;

 private:
  struct Lists;
  const PatternTable<Real>& table_;
  std::unique_ptr<ComputedOnce<Lists>> lists_;
};

extern template class PatternTranspose<float>;
extern template class PatternTranspose<double>;

}  // namespace sublimit
