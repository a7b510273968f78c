// SPDX-License-Identifier: Apache-2.0
#pragma once
// A layer between the library and the Vulkan driver of an engine. It counts calls and live objects, and makes
// selected calls fail.
#include <atomic>
#include <cstring>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "eval/gpu/engine.h"

namespace sublimit::testing {

/// Calls of one function of a device.
struct Calls {
  const char* name;
  PFN_vkVoidFunction wrapper = nullptr;
  std::atomic<std::int64_t> count = 0;      ///< number of calls with an object
  std::atomic<std::int64_t> succeeded = 0;  ///< number of these that succeeded
  std::atomic<std::int64_t> fails_at = -1;  ///< value of `count` at the call that fails; -1: none
  VkResult failure = VK_SUCCESS;
};

class FaultyVulkan {
 public:
  /// There may be only one at a time, since Vulkan's functions have no state.
  explicit FaultyVulkan(const Engine& engine) : engine_(engine) {
    real_ = engine.vk, device_ = engine.device;
    separate_ = without_commands_ = is_pending_ = false;
    ended_too_early_ = 0;
    sizes_.clear();
    for (Calls* calls : all()) calls->count = calls->succeeded = 0, calls->fails_at = -1;
  }

  EngineDevice lent() const {
    EngineDevice lent = engine_.lent();
    lent.get_instance_proc_addr = reinterpret_cast<decltype(lent.get_instance_proc_addr)>(
        static_cast<PFN_vkGetInstanceProcAddr>(&instance_function));
    return lent;
  }

  static Calls& of(const std::string& name) {
    for (Calls* calls : all())
      if (calls->name == name) return *calls;
    throw std::runtime_error("no function " + name);
  }
  /// Makes one call of a function fail, after so many further calls of it.
  static void fail(const std::string& name, std::int64_t after, VkResult failure) {
    Calls& calls = of(name);
    calls.failure = failure;
    calls.fails_at = calls.count + after;
  }
  /// Returns true if that call was made.
  static bool has_failed(const std::string& name) { return of(name).count > of(name).fails_at; }
  static void stop_failing() {
    for (Calls* calls : all()) calls->fails_at = -1;
  }

  /// Returns the number of live objects, by the function that makes them.
  static std::map<std::string, std::int64_t> alive() {
    constexpr const char* pairs[][2] = {{"vkCreateBuffer", "vkDestroyBuffer"},
                                        {"vkAllocateMemory", "vkFreeMemory"},
                                        {"vkCreateShaderModule", "vkDestroyShaderModule"},
                                        {"vkCreatePipelineLayout", "vkDestroyPipelineLayout"},
                                        {"vkCreateComputePipelines", "vkDestroyPipeline"},
                                        {"vkCreateCommandPool", "vkDestroyCommandPool"},
                                        {"vkCreateFence", "vkDestroyFence"}};
    std::map<std::string, std::int64_t> alive;
    for (const auto& [make, end] : pairs) alive[make] = of(make).succeeded - of(end).succeeded;
    return alive;
  }
  static std::int64_t num_alive() {
    std::int64_t sum = 0;
    for (const auto& [make, count] : alive()) {
      EXPECT_GE(count, 0) << make;
      sum += count;
    }
    return sum;
  }
  /// Returns the number of calls that make objects of any kind.
  static std::int64_t num_made() {
    std::int64_t sum = 0;
    for (const Calls* calls : all())
      if (std::strncmp(calls->name, "vkCreate", 8) == 0 || std::strncmp(calls->name, "vkAllocate", 10) == 0)
        sum += calls->count;
    return sum;
  }

  /// Returns the number of objects that were destroyed while work might use them: after a failed wait, and
  /// before a successful one.
  static std::int64_t num_ended_too_early() { return ended_too_early_; }
  /// Returns the bytes of live memory.
  static std::int64_t num_bytes() {
    const std::lock_guard lock(sizes_mutex_);
    std::int64_t sum = 0;
    for (const auto& [memory, size] : sizes_) sum += size;
    return sum;
  }

  /// Pretends to be a discrete GPU, with device memory that the host cannot access, and host memory.
  static void separate_memories() { separate_ = true; }
  /// Drops recorded commands, so that all allocations are those of the library.
  static void leave_out_commands(bool yes) { without_commands_ = yes; }

 private:
  template <auto Member>
  struct Wrapper;
  template <class Result, class... Args, Result (VKAPI_PTR* gpu::VulkanFunctions::*Member)(Args...)>
  struct Wrapper<Member> {
    static inline Calls calls{.name = nullptr};
    static Result VKAPI_PTR call(Args... args) {
      if constexpr (std::is_void_v<Result>) {
        if (without_commands_ && std::strncmp(calls.name, "vkCmd", 5) == 0) return;
        if (ends_nothing(args...)) return;
        if (std::strncmp(calls.name, "vkDestroy", 9) == 0 || std::strncmp(calls.name, "vkFree", 6) == 0)
          ended_too_early_ += is_pending_;
        ++calls.count, ++calls.succeeded;
        (real_.*Member)(args...);
      } else {
        const bool fails = calls.count++ == calls.fails_at;
        if constexpr (std::is_same_v<Result, VkResult>)
          if (fails) {
            // Work goes on behind a wait that fails, but not on a device that is lost. Here it is done in any case.
            reinterpret_cast<PFN_vkDeviceWaitIdle>(real_.vkGetDeviceProcAddr(device_, "vkDeviceWaitIdle"))(device_);
            if (std::strcmp(calls.name, "vkWaitForFences") == 0) is_pending_ = calls.failure != VK_ERROR_DEVICE_LOST;
            return calls.failure;
          }
        if (std::strstr(calls.name, "Wait")) is_pending_ = false;
        const Result result = (real_.*Member)(args...);
        if constexpr (std::is_same_v<Result, VkResult>) calls.succeeded += result == VK_SUCCESS;
        return result;
      }
    }
    /// Returns true for a call of vkDestroyX or vkFreeMemory with a null object.
    static bool ends_nothing(Args... args) {
      if constexpr (sizeof...(Args) == 3) {
        const auto handle = std::get<1>(std::tie(args...));
        if constexpr (std::is_pointer_v<decltype(handle)>)
          return handle == nullptr && (std::strncmp(calls.name, "vkDestroy", 9) == 0 || calls.name[2] == 'F');
      }
      return false;
    }
  };

  static std::span<Calls* const> all() {
    static const std::vector<Calls*> list = [] {
      std::vector<Calls*> made;
#define SUBLIMIT_WRAPPER(function)                                                 \
  {                                                                                \
    using Wrapped = Wrapper<&gpu::VulkanFunctions::function>;                      \
    Wrapped::calls.name = #function;                                               \
    Wrapped::calls.wrapper = reinterpret_cast<PFN_vkVoidFunction>(&Wrapped::call); \
    made.push_back(&Wrapped::calls);                                               \
  }
      SUBLIMIT_VULKAN_DEVICE_FUNCTIONS(SUBLIMIT_WRAPPER)
#undef SUBLIMIT_WRAPPER
      return made;
    }();
    return list;
  }

  static PFN_vkVoidFunction VKAPI_PTR device_function(VkDevice device, const char* name) {
    if (std::strcmp(name, "vkAllocateMemory") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&allocate);
    if (std::strcmp(name, "vkFreeMemory") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&free);
    if (std::strcmp(name, "vkGetBufferMemoryRequirements") == 0)
      return reinterpret_cast<PFN_vkVoidFunction>(&requirements);
    for (const Calls* calls : all())
      if (std::strcmp(calls->name, name) == 0) return calls->wrapper;
    return real_.vkGetDeviceProcAddr(device, name);
  }
  static PFN_vkVoidFunction VKAPI_PTR instance_function(VkInstance instance, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&device_function);
    if (std::strcmp(name, "vkGetPhysicalDeviceMemoryProperties") == 0)
      return reinterpret_cast<PFN_vkVoidFunction>(&memories);
    return gpu::vulkan_loader(nullptr)(instance, name);
  }

  // Separate memories are two names of one that has all properties. Where there is none they are separate already.
  static void VKAPI_PTR memories(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* properties) {
    real_.vkGetPhysicalDeviceMemoryProperties(device, properties);
    if (!separate_) return;
    for (std::uint32_t i = 0; i < properties->memoryTypeCount; ++i) {
      const VkMemoryType type = properties->memoryTypes[i];
      if ((type.propertyFlags & (of_device | of_host)) != (of_device | of_host)) continue;
      whole_ = i;
      properties->memoryTypeCount = 2;
      properties->memoryTypes[0] = {of_device, type.heapIndex};
      properties->memoryTypes[1] = {of_host, type.heapIndex};
      return;
    }
    separate_ = false;
  }
  static void VKAPI_PTR requirements(VkDevice device, VkBuffer buffer, VkMemoryRequirements* needs) {
    real_.vkGetBufferMemoryRequirements(device, buffer, needs);
    if (separate_) needs->memoryTypeBits = 3;
  }
  static VkResult VKAPI_PTR allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                     const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
    VkMemoryAllocateInfo own = *info;
    if (separate_) own.memoryTypeIndex = whole_;
    const VkResult result = Wrapper<&gpu::VulkanFunctions::vkAllocateMemory>::call(device, &own, callbacks, memory);
    const std::lock_guard lock(sizes_mutex_);
    if (result == VK_SUCCESS) sizes_[*memory] = std::int64_t(info->allocationSize);
    return result;
  }
  static void VKAPI_PTR free(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* callbacks) {
    {
      const std::lock_guard lock(sizes_mutex_);
      sizes_.erase(memory);
    }
    Wrapper<&gpu::VulkanFunctions::vkFreeMemory>::call(device, memory, callbacks);
  }

  static constexpr VkMemoryPropertyFlags of_device = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  static constexpr VkMemoryPropertyFlags of_host =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  const Engine& engine_;
  static inline gpu::VulkanFunctions real_;
  static inline VkDevice device_ = VK_NULL_HANDLE;
  static inline std::uint32_t whole_ = 0;
  static inline std::atomic<bool> is_pending_ = false;
  static inline std::atomic<std::int64_t> ended_too_early_ = 0;
  static inline std::mutex sizes_mutex_;
  static inline std::map<VkDeviceMemory, std::int64_t> sizes_;
  static inline bool separate_ = false, without_commands_ = false;
};

}  // namespace sublimit::testing
