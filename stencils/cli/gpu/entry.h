// SPDX-License-Identifier: Apache-2.0
#pragma once
// The part of the program for GPUs: a library that is loaded on first use, so that it can be a package of its
// own.
#include <memory>
#include <string>
#include <vector>

#include "../support/table_applier.h"
#include "sublimit/eval/gpu/gpu_device.h"

namespace sublimit::cli {

/// A device, with its API and its kind as words.
struct DescribedGpu {
  GpuInfo info;
  std::string api, kind;
};

constexpr const char* gpu_library = "libsublimit_gpu.so";
constexpr const char* gpu_devices_entry = "sublimit_gpu_devices";
constexpr const char* gpu_applier_entry = "sublimit_gpu_applier";
/// Type of the function `gpu_devices_entry`, which returns the devices, as `gpu_devices` does.
using GpuDevicesEntry = void(std::vector<DescribedGpu>& devices, std::string& why_none);
/// Type of the function `gpu_applier_entry`, which makes an applier of a table on the device of this number.
using GpuApplierEntry = void(const PatternTable<float>& table, int device,
                             std::unique_ptr<TableApplier<float>>& applier);

}  // namespace sublimit::cli
