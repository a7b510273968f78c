// SPDX-License-Identifier: Apache-2.0
#pragma once
// The part of the program for GPUs, as a library that is loaded when it is wanted: a package of its own can bring it.
#include <memory>
#include <string>
#include <vector>

#include "../support/table_applier.h"
#include "sublimit/eval/gpu/gpu_device.h"

namespace sublimit::cli {

/// A device, and its API and kind in words.
struct DescribedGpu {
  GpuInfo info;
  std::string api, kind;
};

constexpr const char* gpu_library = "libsublimit_gpu.so";
constexpr const char* gpu_devices_entry = "sublimit_gpu_devices";
constexpr const char* gpu_applier_entry = "sublimit_gpu_applier";
/// `gpu_devices`, by a function that has a C name.
using GpuDevicesEntry = void(std::vector<DescribedGpu>& devices, std::string& why_none);
/// Applies a table on the device of this number, likewise.
using GpuApplierEntry = void(const PatternTable<float>& table, int device,
                             std::unique_ptr<TableApplier<float>>& applier);

}  // namespace sublimit::cli
