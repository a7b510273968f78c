// SPDX-License-Identifier: Apache-2.0
#pragma once
// `TableApplier` by an evaluator of the CPU or of a GPU.
#include <utility>

#include "support/table_applier.h"

namespace sublimit::cli {

/// Applier that forwards to an `Evaluator` with the functions of `PatternEvaluator`.
template <class Real, class Evaluator>
class EvaluatorApplier : public TableApplier<Real> {
 public:
  template <class... Arguments>
  explicit EvaluatorApplier(std::string device, const Arguments&... arguments)
      : evaluator_(arguments...), device_(std::move(device)) {}
  const PatternTable<Real>& table() const override { return evaluator_.table(); }
  void apply(std::span<const Real> points, int channels, std::span<Real> result) const override {
    evaluator_.apply(points, channels, result);
  }
  void apply(const Evaluation<Real>& evaluation) const override { evaluator_.apply(evaluation); }
  std::string device() const override { return device_; }

 private:
  Evaluator evaluator_;
  std::string device_;
};

}  // namespace sublimit::cli
