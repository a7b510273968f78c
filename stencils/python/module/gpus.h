// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables on GPUs, for modules that are built with the GPU part.
#include <map>
#include <memory>
#include <mutex>
#include <span>

#include "sublimit/base/error.h"
#include "sublimit/eval/evaluate/evaluation.h"
#include "sublimit/eval/table/pattern_table.h"

namespace sublimit {
class GpuDevice;
class GpuEvaluator;
}  // namespace sublimit

namespace sublimit::python {

/// A table with its copies on GPUs. It is uploaded to a GPU when it is first applied there, and kept. Any
/// number of threads may use it; Python's lock is not needed.
template <class Real>
class TableOnGpus {
 public:
  /// @param table  must outlive this
  explicit TableOnGpus(const PatternTable<Real>& table) : table_(table) {}
  explicit TableOnGpus(const PatternTable<Real>&&) = delete;
  /// Applies the table, or its transpose, on a GPU.
  /// @throws InvalidOption  no such GPU; the message has what is missing and an alternative
  /// @throws ResourceError, IoError, InvalidParameter  as `GpuEvaluator`
  void apply(const Evaluation<Real>& evaluation, int gpu) const;
  void apply_transpose(std::span<const Real> values, int channels, std::span<Real> result, int gpu) const;

 private:
  struct Uploaded {
    std::shared_ptr<const GpuDevice> device;
    std::shared_ptr<const GpuEvaluator> evaluator;
  };
  /// Calls call(evaluator). If the device is lost meanwhile, it is dropped, so that the next call opens it
  /// again.
  template <class Call>
  void on(int gpu, const Call& call) const;

  const PatternTable<Real>& table_;
  mutable std::mutex mutex_;
  mutable std::map<int, Uploaded> uploaded_;
};

/// Tables in double, which GPUs do not apply: all functions throw.
template <>
class TableOnGpus<double> {
 public:
  explicit TableOnGpus(const PatternTable<double>&) {}
  void apply(const Evaluation<double>&, int) const { refuse(); }
  void apply_transpose(std::span<const double>, int, std::span<double>, int) const { refuse(); }

 private:
  [[noreturn]] static void refuse() {
    throw InvalidOption(
        "GPUs apply tables in float, and this one is in double; bake one with precision='float', or apply this one "
        "with device='cpu'");
  }
};

}  // namespace sublimit::python
