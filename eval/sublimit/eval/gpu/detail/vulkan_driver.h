// SPDX-License-Identifier: Apache-2.0
#pragma once
// Devices of Vulkan.
#include <memory>

#include "sublimit/eval/gpu/detail/driver.h"

namespace sublimit::gpu {

/// Returns the devices of Vulkan that can apply tables.
Found vulkan_devices();
/// Opens a device.
/// @param number  index into the devices of `vulkan_devices`
std::shared_ptr<Driver> open_vulkan_device(size_t number);
/// Uses the device of an engine.
std::shared_ptr<Driver> borrow_vulkan_device(const EngineDevice& engine);

}  // namespace sublimit::gpu
