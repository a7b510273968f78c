// SPDX-License-Identifier: Apache-2.0
#pragma once
// The transpose of a table by patterns: what the control points of each patch get from its points, then the sum over
// patches for each control point, in the order of patches.
#include <memory>
#include <span>

#include "sublimit/base/buffer_pool.h"
#include "sublimit/base/found_once.h"
#include "sublimit/pattern_table.h"

namespace sublimit {

template <class Real>
class PatternTranspose {
 public:
  /// @param table  which must stay
  explicit PatternTranspose(const PatternTable<Real>& table);
  explicit PatternTranspose(const PatternTable<Real>&&) = delete;
  ~PatternTranspose();
  PatternTranspose(PatternTranspose&&) noexcept;

  /// See `PatternEvaluator::apply_transpose`.
  void apply(std::span<const Real> values, int channels, std::span<Real> result, bool contract,
             BufferPool<Real>& buffers) const;

 private:
  struct Lists;
  const PatternTable<Real>& table_;
  std::unique_ptr<FoundOnce<Lists>> lists_;
};

extern template class PatternTranspose<float>;
extern template class PatternTranspose<double>;

}  // namespace sublimit
