// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table by patterns, ready to be applied every frame.
#include "sublimit/evaluation.h"
#include "sublimit/packed_blocks.h"
#include "sublimit/pattern_table.h"
#include "sublimit/pattern_transpose.h"

namespace sublimit {

/// Prepared once, applied many times, by any number of threads at once. What is made has the same bits for any number
/// of threads and any division into parts. Memory for points in between is kept from one call to the next.
template <class Real>
class PatternEvaluator {
 public:
  struct Options {
    /// The same bits on machines of any kind: no multiplication is fused with an addition. Without it they are the same
    /// on any one machine.
    bool reproducible = false;
  };
  /// @param table  which must stay
  explicit PatternEvaluator(const PatternTable<Real>& table, Options options = {});
  explicit PatternEvaluator(const PatternTable<Real>&&, Options = {}) = delete;

  const PatternTable<Real>& table() const { return table_; }

  /// As `PatternTable::apply`, to rounding; the same bits if `reproducible`. Nothing is divided: of a rational table
  /// (`TableInfo::rational`) homogeneous columns come from homogeneous columns, and nothing else makes sense.
  /// @throws InvalidParameter  spans of the wrong length, channels < 1
  void apply(std::span<const Real> points, int channels, std::span<Real> result) const;

  /// @throws InvalidParameter  spans that are too short, strides with which numbers overlap, quantities that the table
  ///                           does not have, tangent frames without derivatives or of other than 3 channels
  void apply(const Evaluation<Real>& evaluation) const;

  // The same in parts, for several threads or machines: `apply_first`, if `num_inputs` is not zero; any division of
  // `num_patches` into ranges; when all of them are done, `apply_rest`. Each checks as `apply` does.

  /// Length of what `apply_first` makes: points that the table's first step makes; 0 if it has none.
  std::int64_t num_inputs(const Evaluation<Real>& evaluation) const;
  void apply_first(const Evaluation<Real>& evaluation, std::span<Real> inputs) const;
  std::int64_t num_patches() const { return table_.num_patches(); }
  /// Points of patches [begin, end).
  /// @param inputs  made by `apply_first`; empty if `num_inputs` is zero
  void apply_patches(const Evaluation<Real>& evaluation, std::span<const Real> inputs, std::int64_t begin,
                     std::int64_t end) const;
  /// Points of no patch, and points that are copies of others.
  void apply_rest(const Evaluation<Real>& evaluation, std::span<const Real> inputs) const;

  /// result = sum over quantities of (their rows)^T * values: gradients with regard to control points. Copies count for
  /// what they copy. Sums in one order, so the same bits for any number of threads; those of `reproducible` too.
  /// @param values  quantities x num_points x channels, interleaved, as `apply` makes; or the first ones of the
  ///                quantities alone
  /// @param result  num_control_points x channels, interleaved; overwritten
  /// @throws InvalidParameter  spans of the wrong length, channels < 1
  /// @note  The first call prepares lists as large as the table's columns, which stay.
  void apply_transpose(std::span<const Real> values, int channels, std::span<Real> result) const;

  /// Bytes that this takes besides the table; memory of `apply_transpose` is not counted.
  std::int64_t num_bytes() const { return packed_.num_bytes(); }

 private:
  struct Layouts;
  /// Strides without zeros. What the public functions throw for.
  Layouts check(const Evaluation<Real>& evaluation) const;
  void apply_first(const Evaluation<Real>& evaluation, const Layouts& layouts, std::span<Real> inputs) const;
  void apply_patches(const Evaluation<Real>& evaluation, const Layouts& layouts, std::span<const Real> inputs,
                     std::int64_t begin, std::int64_t end) const;
  void apply_run(const Evaluation<Real>& evaluation, const Layouts& layouts, const Real* points, int frame,
                 size_t group, std::int64_t first, std::int64_t count) const;
  void apply_rational_run(const Evaluation<Real>& evaluation, const Layouts& layouts, const Real* points, int frame,
                          size_t group, std::int64_t first, std::int64_t count) const;
  void apply_rational_rest(const Evaluation<Real>& evaluation, const Layouts& layouts, const Real* points, int frame,
                           std::int64_t begin, std::int64_t end) const;
  void apply_rest(const Evaluation<Real>& evaluation, const Layouts& layouts, std::span<const Real> inputs) const;
  void apply_frames_of_rest(const Evaluation<Real>& evaluation, const Layouts& layouts, const Real* points, int frame,
                            std::int64_t begin, std::int64_t end) const;

  const PatternTable<Real>& table_;
  Options options_;
  PackedBlocks<Real> packed_;
  PatternTranspose<Real> transpose_;
  std::unique_ptr<BufferPool<Real>> buffers_;
};

extern template class PatternEvaluator<float>;
extern template class PatternEvaluator<double>;

}  // namespace sublimit
