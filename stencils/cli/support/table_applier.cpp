// SPDX-License-Identifier: Apache-2.0
#include "support/table_applier.h"

#include "gpu/entry.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "support/evaluator_applier.h"
#include "support/loaded_library.h"

namespace sublimit::cli {

template <class Real>
std::unique_ptr<TableApplier<Real>> cpu_applier(const PatternTable<Real>& table) {
  return std::make_unique<EvaluatorApplier<Real, PatternEvaluator<Real>>>("", table);
}
template std::unique_ptr<TableApplier<float>> cpu_applier(const PatternTable<float>&);
template std::unique_ptr<TableApplier<double>> cpu_applier(const PatternTable<double>&);

std::unique_ptr<TableApplier<float>> gpu_applier(const PatternTable<float>& table, int device) try {
  auto* const make =
      reinterpret_cast<GpuApplierEntry*>(loaded_function(gpu_part, gpu_library, gpu_applier_entry, "results of GPUs"));
  std::unique_ptr<TableApplier<float>> applier;
  make(table, device, applier);
  return applier;
} catch (const InvalidOption& error) {
  throw InvalidOption(error.what() + std::string("; leave out --gpu to apply tables on the CPU"));
}

}  // namespace sublimit::cli
