// SPDX-License-Identifier: Apache-2.0
#pragma once
// Vulkan on this machine, and its devices that can apply tables.
#include <memory>
#include <string>
#include <vector>

#include "sublimit/gpu/driver.h"
#include "sublimit/gpu/vulkan_functions.h"

namespace sublimit::gpu {

/// An instance of our own, and its functions.
struct Instance {
  VulkanFunctions vk;
  VkInstance handle = VK_NULL_HANDLE;
  ~Instance() {
    if (handle) vk.vkDestroyInstance(handle, nullptr);
  }
};

/// @return  null: there is none, `missing` says why
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
