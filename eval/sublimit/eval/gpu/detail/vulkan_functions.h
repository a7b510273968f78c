// SPDX-License-Identifier: Apache-2.0
#pragma once
// Functions of Vulkan, loaded at run time: programs run without Vulkan, and an engine may have its own loader. volk is
// not used: its names are global, and would conflict with another version of it in an engine.
#define VK_NO_PROTOTYPES
#include <vulkan/vulkan.h>

#include <string>

namespace sublimit::gpu {

// clang-format off
#define SUBLIMIT_VULKAN_INSTANCE_FUNCTIONS(f)                                                                     \
  f(vkDestroyInstance) f(vkEnumeratePhysicalDevices) f(vkGetPhysicalDeviceProperties2)                            \
  f(vkGetPhysicalDeviceFeatures2) f(vkGetPhysicalDeviceMemoryProperties)                                          \
  f(vkGetPhysicalDeviceQueueFamilyProperties) f(vkCreateDevice) f(vkGetDeviceProcAddr)
#define SUBLIMIT_VULKAN_DEVICE_FUNCTIONS(f)                                                                       \
  f(vkDestroyDevice) f(vkGetDeviceQueue)                                                                          \
  f(vkCreateBuffer) f(vkDestroyBuffer) f(vkGetBufferMemoryRequirements) f(vkGetBufferDeviceAddress)               \
  f(vkAllocateMemory) f(vkFreeMemory) f(vkBindBufferMemory) f(vkMapMemory)                                        \
  f(vkCreateShaderModule) f(vkDestroyShaderModule) f(vkCreatePipelineLayout) f(vkDestroyPipelineLayout)           \
  f(vkCreateComputePipelines) f(vkDestroyPipeline)                                                                \
  f(vkCreateCommandPool) f(vkDestroyCommandPool) f(vkAllocateCommandBuffers)                                      \
  f(vkBeginCommandBuffer) f(vkEndCommandBuffer) f(vkCreateFence) f(vkDestroyFence) f(vkWaitForFences)             \
  f(vkQueueSubmit) f(vkCmdBindPipeline) f(vkCmdPushConstants) f(vkCmdDispatch) f(vkCmdPipelineBarrier)            \
  f(vkCmdCopyBuffer)
// clang-format on

/// Functions of an instance and of one of its devices.
struct VulkanFunctions {
#define SUBLIMIT_MEMBER(name) PFN_##name name = nullptr;
  SUBLIMIT_VULKAN_INSTANCE_FUNCTIONS(SUBLIMIT_MEMBER)
  SUBLIMIT_VULKAN_DEVICE_FUNCTIONS(SUBLIMIT_MEMBER)
#undef SUBLIMIT_MEMBER
  /// @throws IoError  a function is missing
  void load_instance(PFN_vkGetInstanceProcAddr get, VkInstance instance);
  void load_device(VkDevice device);
};

/// Returns the entry point of this machine's loader; null: there is none.
/// @param missing  set to the reason
PFN_vkGetInstanceProcAddr vulkan_loader(std::string* missing);

/// Checks the result of a call.
/// @throws ResourceError  no memory left, on the host or the device
/// @throws IoError        any other failure
void check(VkResult result, const char* what);

}  // namespace sublimit::gpu
