// SPDX-License-Identifier: Apache-2.0
#include <type_traits>

#include "../support/evaluator_applier.h"
#include "../support/part_version.h"
#include "entry.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/gpu/gpu_evaluator.h"

extern "C" void sublimit_gpu_devices(std::vector<sublimit::cli::DescribedGpu>& devices, std::string& why_none) {
  for (const sublimit::GpuInfo& info : sublimit::gpu_devices(&why_none))
    devices.push_back({info, sublimit::name(info.api), sublimit::name(info.kind)});
}

extern "C" void sublimit_gpu_applier(const sublimit::PatternTable<float>& table, int device,
                                     std::unique_ptr<sublimit::cli::TableApplier<float>>& applier) {
  const sublimit::GpuDevice opened(device);
  const std::string name = opened.info().name + ", " + sublimit::name(opened.info().api);
  applier = std::make_unique<sublimit::cli::EvaluatorApplier<float, sublimit::GpuEvaluator>>(name, table, opened);
}

static_assert(std::is_same_v<decltype(sublimit_gpu_devices), sublimit::cli::GpuDevicesEntry>);
static_assert(std::is_same_v<decltype(sublimit_gpu_applier), sublimit::cli::GpuApplierEntry>);
