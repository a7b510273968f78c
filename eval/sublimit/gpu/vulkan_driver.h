// SPDX-License-Identifier: Apache-2.0
#pragma once
// Devices of Vulkan.
#include <memory>

#include "sublimit/gpu/driver.h"

namespace sublimit::gpu {

Found vulkan_devices();
/// @param number  as `vulkan_devices` has them
std::shared_ptr<Driver> open_vulkan_device(size_t number);
std::shared_ptr<Driver> borrow_vulkan_device(const EngineDevice& engine);

}  // namespace sublimit::gpu
