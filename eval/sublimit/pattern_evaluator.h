// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table by patterns, ready to be applied every frame.
#include "sublimit/pattern_table.h"

namespace sublimit {

/// Prepared once, applied many times, by any number of threads at once.
template <class Real>
class PatternEvaluator {
 public:
  struct Options {
    /// The same bits on machines of any kind: no multiplication is fused with an addition. Without it they are the same
    /// on any one machine, for any number of threads.
    bool reproducible = false;
  };
  /// @param table  which must stay
  explicit PatternEvaluator(const PatternTable<Real>& table, Options options = {});

  /// As `PatternTable::apply`, to rounding.
  /// @throws InvalidParameter  spans of the wrong length, channels < 1
  void apply(std::span<const Real> points, int channels, std::span<Real> result) const;

  /// Bytes that this takes besides the table.
  std::int64_t num_bytes() const { return std::int64_t(weights_.size()) * std::int64_t(sizeof(Real)); }

 private:
  struct Packed {
    std::int64_t weights = 0;  // where they begin, quantity after quantity
    std::int32_t stride = 0;
  };
  const PatternTable<Real>& table_;
  Options options_;
  std::vector<Packed> packed_;  // by group
  std::vector<Real> weights_;
};

extern template class PatternEvaluator<float>;
extern template class PatternEvaluator<double>;

}  // namespace sublimit
