// SPDX-License-Identifier: Apache-2.0
#pragma once
// An engine that uses tables, for tests: an instance without a window, a device, a queue, its own command
// buffers and buffers, optionally checked by Vulkan's validation layer.
#include <cstring>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "sublimit/eval/gpu/detail/vulkan_functions.h"
#include "sublimit/eval/gpu/gpu_device.h"

namespace sublimit::testing {

inline void succeed(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + ": Vulkan's error " + std::to_string(result));
}

/// Errors and warnings of the validation layer.
class Messages {
 public:
  std::vector<std::string> all() const {
    const std::lock_guard lock(mutex_);
    return all_;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    all_.clear();
  }
  VkDebugUtilsMessengerCreateInfoEXT listener() {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = [](VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT type,
                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) -> VkBool32 {
      // What loaders say of drivers that are not used is no message about the use of Vulkan.
      if (type == VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT) return VK_FALSE;
      auto& messages = *static_cast<Messages*>(user);
      const std::lock_guard lock(messages.mutex_);
      messages.all_.emplace_back(data->pMessage);
      return VK_FALSE;
    };
    info.pUserData = this;
    return info;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> all_;
};

class Engine {
 public:
  static constexpr const char* layer = "VK_LAYER_KHRONOS_validation";

  static bool layer_is_there() {
    const auto list = entry<PFN_vkEnumerateInstanceLayerProperties>("vkEnumerateInstanceLayerProperties");
    std::uint32_t count = 0;
    succeed(list(&count, nullptr), "layers");
    std::vector<VkLayerProperties> layers(count);
    succeed(list(&count, layers.data()), "layers");
    for (const VkLayerProperties& l : layers)
      if (std::strcmp(l.layerName, layer) == 0) return true;
    return false;
  }

  /// @param messages  receives the messages of the validation layer, including synchronisation; null: no
  ///                  validation
  explicit Engine(Messages* messages = nullptr) {
    make_instance(messages);
    try {
      make_device();
    } catch (...) {
      end();
      throw;
    }
  }
  ~Engine() { end(); }
  Engine(const Engine&) = delete;

  gpu::VulkanFunctions vk;
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t family = 0;
  bool halves = false;

  EngineDevice lent() const {
    return {.instance = instance,
            .physical_device = physical,
            .device = device,
            .queue = queue,
            .queue_family = family,
            .halves = halves};
  }

  struct Buffer {
    const Engine& engine;
    VkBuffer handle = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::byte* mapped = nullptr;
    std::uint64_t address = 0;
    std::int64_t num_bytes = 0;

    Buffer(const Engine& e, std::int64_t bytes) : engine(e), num_bytes(bytes) { e.make(*this); }
    ~Buffer() {
      engine.vk.vkDestroyBuffer(engine.device, handle, nullptr);
      engine.vk.vkFreeMemory(engine.device, memory, nullptr);
    }
    Buffer(const Buffer&) = delete;
    template <class T>
    std::vector<T> numbers() const {
      std::vector<T> all(size_t(num_bytes) / sizeof(T));
      std::memcpy(all.data(), mapped, all.size() * sizeof(T));
      return all;
    }
  };
  std::unique_ptr<Buffer> buffer(std::int64_t bytes) const { return std::make_unique<Buffer>(*this, bytes); }
  /// Returns a buffer with these numbers.
  template <class T>
  std::unique_ptr<Buffer> buffer_of(const std::vector<T>& numbers) const {
    auto made = buffer(std::int64_t(numbers.size() * sizeof(T)));
    std::memcpy(made->mapped, numbers.data(), numbers.size() * sizeof(T));
    return made;
  }

  /// Returns a command buffer that is being recorded; it is valid until it is run.
  VkCommandBuffer begin() const {
    VkCommandBufferAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = pool_;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    succeed(vk.vkAllocateCommandBuffers(device, &info, &commands), "commands");
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    succeed(vk.vkBeginCommandBuffer(commands, &begin), "begin");
    return commands;
  }
  /// Records a barrier between previous and later commands, and reads of the host.
  void barrier(VkCommandBuffer commands) const {
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask =
        VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_HOST_READ_BIT;
    constexpr VkPipelineStageFlags work = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    vk.vkCmdPipelineBarrier(commands, work, work | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
  }
  void run(VkCommandBuffer commands) const {
    succeed(vk.vkEndCommandBuffer(commands), "end");
    VkFenceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VkFence fence = VK_NULL_HANDLE;
    succeed(vk.vkCreateFence(device, &info, nullptr, &fence), "fence");
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    succeed(vk.vkQueueSubmit(queue, 1, &submit, fence), "submit");
    succeed(vk.vkWaitForFences(device, 1, &fence, VK_TRUE, UINT64_MAX), "wait");
    vk.vkDestroyFence(device, fence, nullptr);
  }

 private:
  template <class Function>
  static Function entry(const char* name, VkInstance instance = VK_NULL_HANDLE) {
    std::string missing;
    const PFN_vkGetInstanceProcAddr get = gpu::vulkan_loader(&missing);
    if (!get) throw std::runtime_error(missing);
    return reinterpret_cast<Function>(get(instance, name));
  }

  void make_instance(Messages* messages) {
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    const VkValidationFeatureEnableEXT enabled[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = enabled;
    VkDebugUtilsMessengerCreateInfoEXT listener{};
    if (messages) {
      listener = messages->listener();
      features.pNext = &listener;  // of the making and the end of the instance, too
      info.pNext = &features;
      info.enabledLayerCount = 1;
      info.ppEnabledLayerNames = &layer;
      info.enabledExtensionCount = 2;
      info.ppEnabledExtensionNames = extensions;
    }
    succeed(entry<PFN_vkCreateInstance>("vkCreateInstance")(&info, nullptr, &instance), "instance");
    vk.load_instance(gpu::vulkan_loader(nullptr), instance);
    if (!messages) return;
    listener.pNext = nullptr;
    succeed(entry<PFN_vkCreateDebugUtilsMessengerEXT>("vkCreateDebugUtilsMessengerEXT", instance)(instance, &listener,
                                                                                                  nullptr, &messenger_),
            "messenger");
  }

  void make_device() {
    std::uint32_t count = 0;
    succeed(vk.vkEnumeratePhysicalDevices(instance, &count, nullptr), "devices");
    std::vector<VkPhysicalDevice> devices(count);
    succeed(vk.vkEnumeratePhysicalDevices(instance, &count, devices.data()), "devices");
    VkPhysicalDevice16BitStorageFeatures half{};
    half.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_16BIT_STORAGE_FEATURES;
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
    addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
    addresses.pNext = &half;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &addresses;
    for (const VkPhysicalDevice candidate : devices) {
      physical = candidate;
      vk.vkGetPhysicalDeviceFeatures2(physical, &features);
      if (addresses.bufferDeviceAddress) break;
    }
    if (!addresses.bufferDeviceAddress) throw std::runtime_error("no device has buffer device addresses");
    vk.vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    while (family + 1 < count && !(families[family].queueFlags & VK_QUEUE_COMPUTE_BIT)) ++family;

    const float priority = 1;
    VkDeviceQueueCreateInfo queue_info{};
    queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue_info.queueFamilyIndex = family;
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;
    halves = half.storageBuffer16BitAccess != VK_FALSE;
    VkPhysicalDevice16BitStorageFeatures wanted_half{};
    wanted_half.sType = half.sType;
    wanted_half.storageBuffer16BitAccess = half.storageBuffer16BitAccess;
    VkPhysicalDeviceBufferDeviceAddressFeatures wanted_addresses{};
    wanted_addresses.sType = addresses.sType;
    wanted_addresses.pNext = &wanted_half;
    wanted_addresses.bufferDeviceAddress = VK_TRUE;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &wanted_addresses;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue_info;
    succeed(vk.vkCreateDevice(physical, &info, nullptr, &device), "device");
    vk.load_device(device);
    vk.vkGetDeviceQueue(device, family, 0, &queue);
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.queueFamilyIndex = family;
    succeed(vk.vkCreateCommandPool(device, &pool, nullptr, &pool_), "pool");
  }

  void make(Buffer& made) const {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = VkDeviceSize(made.num_bytes > 0 ? made.num_bytes : 4);
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                 VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    succeed(vk.vkCreateBuffer(device, &info, nullptr, &made.handle), "buffer");
    VkMemoryRequirements needs{};
    vk.vkGetBufferMemoryRequirements(device, made.handle, &needs);
    VkPhysicalDeviceMemoryProperties memory{};
    vk.vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    constexpr VkMemoryPropertyFlags reached =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    std::uint32_t type = 0;
    while (type < memory.memoryTypeCount &&
           (!(needs.memoryTypeBits >> type & 1) || (memory.memoryTypes[type].propertyFlags & reached) != reached))
      ++type;
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocate.pNext = &flags;
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex = type;
    succeed(vk.vkAllocateMemory(device, &allocate, nullptr, &made.memory), "memory");
    succeed(vk.vkBindBufferMemory(device, made.handle, made.memory, 0), "bind");
    void* mapped = nullptr;
    succeed(vk.vkMapMemory(device, made.memory, 0, VK_WHOLE_SIZE, 0, &mapped), "map");
    made.mapped = static_cast<std::byte*>(mapped);
    VkBufferDeviceAddressInfo address{};
    address.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
    address.buffer = made.handle;
    made.address = vk.vkGetBufferDeviceAddress(device, &address);
  }

  void end() {
    if (pool_) vk.vkDestroyCommandPool(device, pool_, nullptr);
    if (device) vk.vkDestroyDevice(device, nullptr);
    if (messenger_)
      entry<PFN_vkDestroyDebugUtilsMessengerEXT>("vkDestroyDebugUtilsMessengerEXT", instance)(instance, messenger_,
                                                                                              nullptr);
    if (instance) vk.vkDestroyInstance(instance, nullptr);
  }

  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace sublimit::testing
