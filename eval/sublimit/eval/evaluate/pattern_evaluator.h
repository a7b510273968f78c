// SPDX-License-Identifier: Apache-2.0
#pragma once
// Applying a table by patterns, every frame: any number of channels and frames, other layouts, derivatives, normals.
// `Table` of eval/table.h has an evaluator, and owns the table that it refers to:
//
//   const Table table = load("level3.safetensors");
//   const PatternEvaluator<float>& evaluator = table.evaluator<float>();
//   Evaluation<float> frame{.points = points, .point_layout = PointLayout::planar(table.num_control_points())};
//   frame.quantities[0] = positions;  // points, positions: std::vector<float>
//   evaluator.apply(frame);
#include <cstdint>
#include <memory>
#include <span>

#include "sublimit/eval/evaluate/evaluation.h"
#include "sublimit/eval/table/pattern_table.h"

namespace sublimit {

template <class Real>
class BufferPool;
template <class Real>
class PackedBlocks;
template <class Real>
class PatternTranspose;

/// An evaluator of a table: prepared once, applied many times. Any number of threads may use it at once. Results have
/// the same bits for any number of threads and any division into parts. Temporary memory is kept for the next call.
template <class Real>
class PatternEvaluator {
 public:
  /// Options of an evaluator.
  struct Options {
    /// Makes results have the same bits on machines of any kind, by fusing no multiplication with an addition; a little
    /// slower. Without it they are the same on any one machine.
    bool reproducible = false;
  };
  /// Prepares a table.
  /// @param table  must outlive the evaluator
  explicit PatternEvaluator(const PatternTable<Real>& table, Options options = {});
  explicit PatternEvaluator(const PatternTable<Real>&&, Options = {}) = delete;
  ~PatternEvaluator();
  PatternEvaluator(PatternEvaluator&&) noexcept;

  const PatternTable<Real>& table() const { return table_; }

  /// Makes all quantities of one frame. The result is that of `PatternTable::apply` to rounding, and has the same bits
  /// if `reproducible`. Homogeneous columns of a rational table (`TableInfo::rational`) are not divided: the result
  /// consists of such columns too.
  /// @param points    num_control_points x channels, interleaved
  /// @param result    quantities x num_points x channels, interleaved: all positions first; must not overlap `points`
  /// @throws InvalidParameter  spans of the wrong length, channels < 1
  void apply(std::span<const Real> points, int channels, std::span<Real> result) const;

  /// Makes the results that an evaluation asks for.
  /// @throws InvalidParameter  spans that are too short, strides with which numbers overlap, quantities that the table
  ///                           does not have, tangent frames without derivatives or of other than 3 channels
  void apply(const Evaluation<Real>& evaluation) const;

  // An evaluation in parts, for several threads or machines: `apply_first` if `num_inputs` is not zero; then
  // `apply_patches` for any division of the patches into ranges; then `apply_rest`. Each throws as `apply`.

  /// Returns the number of numbers that `apply_first` makes; 0 if the table has no first step.
  std::int64_t num_inputs(const Evaluation<Real>& evaluation) const;
  /// Makes the points that patches are applied to, by the table's first step.
  /// @param inputs  `num_inputs` numbers
  void apply_first(const Evaluation<Real>& evaluation, std::span<Real> inputs) const;
  /// Returns the number of patches.
  std::int64_t num_patches() const { return table_.num_patches(); }
  /// Makes the points of patches [begin, end).
  /// @param inputs  made by `apply_first`; empty if `num_inputs` is zero
  void apply_patches(const Evaluation<Real>& evaluation, std::span<const Real> inputs, std::int64_t begin,
                     std::int64_t end) const;
  /// Makes the points of no patch, and copies points that lie on several patches.
  /// @param inputs  made by `apply_first`; empty if `num_inputs` is zero
  void apply_rest(const Evaluation<Real>& evaluation, std::span<const Real> inputs) const;

  /// Applies the transpose: makes gradients with respect to control points, result = sum over quantities of
  /// (their rows)^T * values. Values at copies are added to the points that they copy. Sums have one order: the same
  /// bits for any number of threads, with `reproducible` on machines of any kind.
  /// @param values  quantities x num_points x channels, interleaved; or the first quantities alone
  /// @param result  num_control_points x channels, interleaved; overwritten
  /// @throws InvalidParameter  spans of the wrong length, channels < 1
  /// @note  The first call prepares lists as large as the table's columns, which are kept.
  void apply_transpose(std::span<const Real> values, int channels, std::span<Real> result) const;

  /// Returns the size in bytes of the packed weights, which are kept besides the table. Temporary memory and the lists
  /// of `apply_transpose` are not counted.
  std::int64_t num_bytes() const;

 private:
  struct Layouts;
  /// Returns strides without zeros; throws for all that the public functions refuse.
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
  std::unique_ptr<const PackedBlocks<Real>> packed_;
  std::unique_ptr<const PatternTranspose<Real>> transpose_;
  std::unique_ptr<BufferPool<Real>> buffers_;
};

extern template class PatternEvaluator<float>;
extern template class PatternEvaluator<double>;

}  // namespace sublimit
