// SPDX-License-Identifier: Apache-2.0
#include "table_applier.h"

#include "optional_parts.h"
#include "sublimit/base/error.h"
#include "sublimit/pattern_evaluator.h"
#ifdef SUBLIMIT_GPU
#include "sublimit/gpu/gpu_evaluator.h"
#endif

namespace sublimit::cli {
namespace {

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

}  // namespace

template <class Real>
std::unique_ptr<TableApplier<Real>> cpu_applier(const PatternTable<Real>& table) {
  return std::make_unique<EvaluatorApplier<Real, PatternEvaluator<Real>>>("", table);
}
template std::unique_ptr<TableApplier<float>> cpu_applier(const PatternTable<float>&);
template std::unique_ptr<TableApplier<double>> cpu_applier(const PatternTable<double>&);

#ifdef SUBLIMIT_GPU
std::unique_ptr<TableApplier<float>> gpu_applier(const PatternTable<float>& table, int device) {
  const GpuDevice opened = [&] {
    try {
      return GpuDevice(device);
    } catch (const InvalidOption& error) {
      throw InvalidOption(error.what() + std::string("; leave out --gpu to apply tables on the CPU"));
    }
  }();
  const std::string name = opened.info().name + ", " + sublimit::name(opened.info().api);
  return std::make_unique<EvaluatorApplier<float, GpuEvaluator>>(name, table, opened);
}
#else
std::unique_ptr<TableApplier<float>> gpu_applier(const PatternTable<float>&, int) {
  throw InvalidOption("this program was built without its part for GPUs: " + how_to_build(gpu_part) +
                      "; leave out --gpu to apply tables on the CPU");
}
#endif

}  // namespace sublimit::cli
