// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/detail/vulkan_functions.h"

#include <dlfcn.h>

#include "sublimit/base/error.h"
#include "sublimit/eval/gpu/detail/driver.h"

namespace sublimit::gpu {

void VulkanFunctions::load_instance(PFN_vkGetInstanceProcAddr get, VkInstance instance) {
#define SUBLIMIT_LOAD(name)                                  \
  name = reinterpret_cast<PFN_##name>(get(instance, #name)); \
  if (!name) throw IoError("this machine's Vulkan lacks " #name "; version 1.2 is needed");
  SUBLIMIT_VULKAN_INSTANCE_FUNCTIONS(SUBLIMIT_LOAD)
#undef SUBLIMIT_LOAD
}

void VulkanFunctions::load_device(VkDevice device) {
#define SUBLIMIT_LOAD(name)                                                \
  name = reinterpret_cast<PFN_##name>(vkGetDeviceProcAddr(device, #name)); \
  if (!name) throw IoError("the Vulkan device lacks " #name "; version 1.2 is needed");
  SUBLIMIT_VULKAN_DEVICE_FUNCTIONS(SUBLIMIT_LOAD)
#undef SUBLIMIT_LOAD
}

PFN_vkGetInstanceProcAddr vulkan_loader(std::string* missing) {
  static void* const library = ::dlopen("libvulkan.so.1", RTLD_NOW);
  if (!library) {
    if (missing) *missing = "there is no Vulkan loader, libvulkan.so.1 (Debian: libvulkan1)";
    return nullptr;
  }
  return reinterpret_cast<PFN_vkGetInstanceProcAddr>(::dlsym(library, "vkGetInstanceProcAddr"));
}

void check(VkResult result, const char* what) {
  switch (result) {
    case VK_SUCCESS:
      return;
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_TOO_MANY_OBJECTS:
      fail_without_memory(what);
    case VK_ERROR_DEVICE_LOST:
      fail_lost(what);
    default:
      fail_otherwise(what + std::string(": Vulkan's error ") + std::to_string(result));
  }
}

}  // namespace sublimit::gpu
