// SPDX-License-Identifier: Apache-2.0
#pragma once
// Devices of CUDA, through the library of NVIDIA's driver.
#include <memory>

#include "sublimit/gpu/driver.h"

namespace sublimit::gpu {

Found cuda_devices();
/// @param number  as `cuda_devices` has them
std::shared_ptr<Driver> open_cuda_device(size_t number);

}  // namespace sublimit::gpu
