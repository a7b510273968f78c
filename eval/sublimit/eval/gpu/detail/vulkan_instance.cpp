// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/detail/vulkan_instance.h"

#include <algorithm>
#include <utility>

#include "sublimit/eval/gpu/detail/vulkan_driver.h"

namespace sublimit::gpu {
namespace {

GpuKind kind_of(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return GpuKind::discrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return GpuKind::integrated;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return GpuKind::cpu;
    default:
      return GpuKind::virtual_machine;
  }
}

}  // namespace

std::unique_ptr<Instance> make_instance(std::string& missing) {
  const PFN_vkGetInstanceProcAddr get = vulkan_loader(&missing);
  if (!get) return nullptr;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(get(nullptr, "vkCreateInstance"));
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "sublimit";
  application.apiVersion = VK_API_VERSION_1_2;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  auto instance = std::make_unique<Instance>();
  VkInstance handle = VK_NULL_HANDLE;
  if (const VkResult result = create ? create(&info, nullptr, &handle) : VK_ERROR_INITIALIZATION_FAILED;
      result != VK_SUCCESS) {
    missing = result == VK_ERROR_INCOMPATIBLE_DRIVER ? "Vulkan finds no driver (Debian: mesa-vulkan-drivers)"
                                                     : "Vulkan cannot be started, error " + std::to_string(result);
    return nullptr;
  }
  instance->vk.load_instance(get, handle);
  instance->handle = handle;
  return instance;
}

GpuInfo info_of(const VulkanFunctions& vk, VkPhysicalDevice device) {
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vk.vkGetPhysicalDeviceProperties2(device, &properties);
  VkPhysicalDeviceMemoryProperties memory{};
  vk.vkGetPhysicalDeviceMemoryProperties(device, &memory);
  GpuInfo info{properties.properties.deviceName,
               GpuApi::vulkan,
               kind_of(properties.properties.deviceType),
               std::string(driver.driverName) + " " + driver.driverInfo,
               0,
               false};
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
    if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
      info.memory = std::max(info.memory, std::int64_t(memory.memoryHeaps[i].size));
  return info;
}

std::vector<Usable> usable_devices(const Instance& instance) {
  const VulkanFunctions& vk = instance.vk;
  std::uint32_t count = 0;
  check(vk.vkEnumeratePhysicalDevices(instance.handle, &count, nullptr), "listing its devices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vk.vkEnumeratePhysicalDevices(instance.handle, &count, devices.data()), "listing its devices");
  std::vector<Usable> usable;
  for (const VkPhysicalDevice device : devices) {
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    vk.vkGetPhysicalDeviceProperties2(device, &properties);
    if (properties.properties.apiVersion < VK_API_VERSION_1_2) continue;
    VkPhysicalDevice16BitStorageFeatures halves{};
    halves.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_16BIT_STORAGE_FEATURES;
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
    addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
    addresses.pNext = &halves;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &addresses;
    vk.vkGetPhysicalDeviceFeatures2(device, &features);
    if (!addresses.bufferDeviceAddress) continue;
    std::uint32_t families = 0;
    vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &families, nullptr);
    std::vector<VkQueueFamilyProperties> queues(families);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &families, queues.data());
    // A queue that draws nothing, where there is one: graphics do not wait for it, nor it for them.
    auto queue = queues.end();
    for (auto q = queues.begin(); q != queues.end(); ++q)
      if (q->queueFlags & VK_QUEUE_COMPUTE_BIT && (queue == queues.end() || !(q->queueFlags & VK_QUEUE_GRAPHICS_BIT))) {
        queue = q;
        if (!(q->queueFlags & VK_QUEUE_GRAPHICS_BIT)) break;
      }
    if (queue == queues.end()) continue;
    Usable found{device, std::uint32_t(queue - queues.begin()), info_of(vk, device)};
    found.info.halves = halves.storageBuffer16BitAccess;
    usable.push_back(std::move(found));
  }
  return usable;
}

Found vulkan_devices() {
  Found found;
  const std::unique_ptr<Instance> instance = make_instance(found.missing);
  if (!instance) return found;
  for (Usable& usable : usable_devices(*instance)) found.devices.push_back(std::move(usable.info));
  if (found.devices.empty())
    found.missing = "Vulkan shows no device of version 1.2 with buffer device addresses (Debian: mesa-vulkan-drivers)";
  return found;
}

}  // namespace sublimit::gpu
