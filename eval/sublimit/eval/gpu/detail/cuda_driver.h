// SPDX-License-Identifier: Apache-2.0
#pragma once
// Devices of CUDA, through the library of NVIDIA's driver.
#include <memory>

#include "sublimit/eval/gpu/detail/driver.h"

namespace sublimit::gpu {

/// Returns the devices of CUDA that can apply tables.
Found cuda_devices();
/// Opens a device.
/// @param number  index into the devices of `cuda_devices`
std::shared_ptr<Driver> open_cuda_device(size_t number);

}  // namespace sublimit::gpu
