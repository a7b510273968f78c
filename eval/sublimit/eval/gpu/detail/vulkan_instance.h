// SPDX-License-Identifier: Apache-2.0
#pragma once
// An instance of Vulkan on this machine, and its devices that can apply tables.
#include <memory>
#include <string>
#include <vector>

#include "sublimit/eval/gpu/detail/driver.h"
#include "sublimit/eval/gpu/detail/vulkan_functions.h"

namespace sublimit::gpu {

/// An instance and its functions.
struct Instance {
  VulkanFunctions vk;
  VkInstance handle = VK_NULL_HANDLE;
  ~Instance() {
    if (handle) vk.vkDestroyInstance(handle, nullptr);
  }
};

/// Makes an instance; null: this machine has no Vulkan, and `missing` is set to the reason.
std::unique_ptr<Instance> make_instance(std::string& missing);

/// A device that can apply tables.
struct Usable {
  VkPhysicalDevice device = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  GpuInfo info;
};

GpuInfo info_of(const VulkanFunctions& vk, VkPhysicalDevice device);
std::vector<Usable> usable_devices(const Instance& instance);

}  // namespace sublimit::gpu
