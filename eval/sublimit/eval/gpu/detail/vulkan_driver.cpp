// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/detail/vulkan_driver.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/eval/gpu/detail/compiled_kernels.h"
#include "sublimit/eval/gpu/detail/vulkan_instance.h"

namespace sublimit::gpu {
namespace {

constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                     VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
/// Copied at once between host and device.
constexpr std::int64_t staging_bytes = std::int64_t{32} << 20;

/// Times that a wait is tried which fails for want of memory, a millisecond apart.
constexpr int most_waits = 10000;

class VulkanDriver;

/// A buffer with its memory, mapped where the host can reach it.
class Buffer {
 public:
  enum class Where { device, host };
  Buffer(VulkanDriver& driver, std::int64_t bytes, Where where);
  ~Buffer();
  Buffer(const Buffer&) = delete;
  VkBuffer handle() const { return buffer_; }
  std::byte* mapped() const { return mapped_; }
  std::uint64_t address() const;

 private:
  VulkanDriver& driver_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::byte* mapped_ = nullptr;
};

class VulkanDriver : public Driver, public std::enable_shared_from_this<VulkanDriver> {
 public:
  VulkanDriver(std::unique_ptr<Instance> instance, const Usable& usable) : instance_(std::move(instance)) {
    vk = instance_->vk;
    info_ = usable.info;
    physical_ = usable.device;
    family_ = usable.queue_family;
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkPhysicalDevice16BitStorageFeatures halves{};
    halves.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_16BIT_STORAGE_FEATURES;
    halves.storageBuffer16BitAccess = info_.halves;
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
    addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
    addresses.pNext = &halves;
    addresses.bufferDeviceAddress = VK_TRUE;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &addresses;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    check(vk.vkCreateDevice(physical_, &info, nullptr, &device), "opening it");
    // What is thrown from here on finds no destructor.
    try {
      vk.load_device(device);
      vk.vkGetDeviceQueue(device, family_, 0, &queue_);
      prepare_device();
    } catch (...) {
      if (vk.vkDestroyDevice) vk.vkDestroyDevice(device, nullptr);
      throw;
    }
    is_own_ = true;
  }

  explicit VulkanDriver(const EngineDevice& engine) {
    std::string missing;
    auto get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(engine.get_instance_proc_addr);
    if (!get) get = vulkan_loader(&missing);
    if (!get) throw IoError(missing);
    if (!engine.instance || !engine.physical_device || !engine.device || !engine.queue)
      throw InvalidParameter("an engine's device needs an instance, a physical device, a device and a queue");
    vk.load_instance(get, engine.instance);
    physical_ = engine.physical_device;
    device = engine.device;
    vk.load_device(device);
    queue_ = engine.queue;
    family_ = engine.queue_family;
    info_ = info_of(vk, physical_);
    info_.halves = engine.halves;
    prepare_device();
  }

  ~VulkanDriver() override {
    for (const auto& [variant, pipeline] : pipelines_) vk.vkDestroyPipeline(device, pipeline, nullptr);
    staging_.reset();
    if (layout_) vk.vkDestroyPipelineLayout(device, layout_, nullptr);
    if (is_own_) vk.vkDestroyDevice(device, nullptr);
  }

  std::unique_ptr<Memory> allocate(std::int64_t bytes) override;
  std::unique_ptr<Recording> begin() override;

  void prepare(const Variant& variant) override {
    {
      const std::lock_guard lock(pipelines_mutex_);
      if (pipelines_.contains(variant)) return;
    }
    // Without the lock, which those who record take: compiling takes long.
    const std::span<const std::uint32_t> code = spirv_of(variant.kernel, variant.half);
    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module_info.codeSize = code.size_bytes();
    module_info.pCode = code.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vk.vkCreateShaderModule(device, &module_info, nullptr, &module), "loading a kernel");
    const std::array<std::int32_t, 4> constants{variant.quantities, variant.channels, variant.rows, variant.patches};
    std::array<VkSpecializationMapEntry, 4> entries{};
    for (std::uint32_t i = 0; i < entries.size(); ++i) entries[i] = {i, 4 * i, 4};
    const VkSpecializationInfo specialization{entries.size(), entries.data(), sizeof constants, constants.data()};
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialization;
    info.layout = layout_;
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult result = vk.vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
    vk.vkDestroyShaderModule(device, module, nullptr);
    check(result, "compiling a kernel");
    const std::lock_guard lock(pipelines_mutex_);
    if (!pipelines_.emplace(variant, pipeline).second)
      vk.vkDestroyPipeline(device, pipeline, nullptr);  // another thread's
  }

  void record(void* commands, const Launch& launch) override {
    const auto buffer = static_cast<VkCommandBuffer>(commands);
    if (launch.waits) {
      VkMemoryBarrier barrier{};
      barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
      barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
      barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
      vk.vkCmdPipelineBarrier(buffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1,
                              &barrier, 0, nullptr, 0, nullptr);
    }
    vk.vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline(launch.variant));
    // Rows of workgroups, as many as the device takes; kernels leave out those behind the last.
    const std::int64_t width = std::min<std::int64_t>(launch.workgroups, most_workgroups_[0]),
                       height = (launch.workgroups + width - 1) / width;
    if (height > most_workgroups_[1])
      throw ResourceError(std::to_string(launch.workgroups) + " workgroups; the GPU takes " +
                          std::to_string(std::int64_t{most_workgroups_[0]} * most_workgroups_[1]));
    Arguments arguments = launch.arguments;
    for (int frame = 0; frame < launch.frames; frame += int(most_workgroups_[2])) {
      vk.vkCmdPushConstants(buffer, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof arguments, &arguments);
      const int frames = std::min(launch.frames - frame, int(most_workgroups_[2]));
      vk.vkCmdDispatch(buffer, std::uint32_t(width), std::uint32_t(height), std::uint32_t(frames));
      advance_frames(arguments, frames, launch.variant.half);
    }
  }

  /// What kernels and copies wrote, to all that comes later.
  void make_visible(VkCommandBuffer commands) {
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                            VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
    vk.vkCmdPipelineBarrier(
        commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
        &barrier, 0, nullptr, 0, nullptr);
  }

  /// Submits and waits.
  void run(VkCommandBuffer commands) {
    VkFenceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VkFence fence = VK_NULL_HANDLE;
    check(vk.vkCreateFence(device, &info, nullptr, &fence), "making a fence");
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    VkResult result = VK_SUCCESS;
    {
      const std::lock_guard lock(queue_mutex_);
      result = vk.vkQueueSubmit(queue_, 1, &submit, fence);
    }
    if (result == VK_SUCCESS) {
      // Nothing of it may be freed while it runs, so a wait that fails for want of memory is tried again, for a while.
      for (int tries = 0; tries < most_waits; ++tries) {
        result = vk.vkWaitForFences(device, 1, &fence, VK_TRUE, UINT64_MAX);
        if (result != VK_ERROR_OUT_OF_HOST_MEMORY && result != VK_ERROR_OUT_OF_DEVICE_MEMORY) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      if (result != VK_SUCCESS) result = VK_ERROR_DEVICE_LOST;  // nobody knows when it ends
    }
    vk.vkDestroyFence(device, fence, nullptr);
    check(result, "running a kernel");
  }

  /// Between the host and a buffer that it cannot reach, some at a time.
  void copy(VkBuffer buffer, std::int64_t at, std::byte* bytes, std::int64_t count, bool to_device);

  /// A command buffer that begins, freed at the end.
  class Commands {
   public:
    explicit Commands(VulkanDriver& driver) : driver_(driver) {
      VkCommandPoolCreateInfo pool{};
      pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
      pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
      pool.queueFamilyIndex = driver_.family_;
      check(driver_.vk.vkCreateCommandPool(driver_.device, &pool, nullptr, &pool_), "making a command pool");
      VkCommandBufferAllocateInfo info{};
      info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
      info.commandPool = pool_;
      info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
      info.commandBufferCount = 1;
      VkCommandBufferBeginInfo begin{};
      begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
      begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
      VkResult result = driver_.vk.vkAllocateCommandBuffers(driver_.device, &info, &commands_);
      if (result == VK_SUCCESS) result = driver_.vk.vkBeginCommandBuffer(commands_, &begin);
      if (result != VK_SUCCESS) driver_.vk.vkDestroyCommandPool(driver_.device, pool_, nullptr);
      check(result, "making a command buffer");
    }
    ~Commands() { driver_.vk.vkDestroyCommandPool(driver_.device, pool_, nullptr); }
    Commands(const Commands&) = delete;
    VkCommandBuffer handle() const { return commands_; }
    void run() {
      check(driver_.vk.vkEndCommandBuffer(commands_), "recording commands");
      driver_.run(commands_);
    }

   private:
    VulkanDriver& driver_;
    VkCommandPool pool_ = VK_NULL_HANDLE;  // its own: pools are of one thread
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
  };

  VulkanFunctions vk;
  VkDevice device = VK_NULL_HANDLE;

  /// Kinds of memory that a buffer may have, with these properties.
  std::optional<std::uint32_t> memory_type(std::uint32_t allowed, VkMemoryPropertyFlags properties) const {
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
      if (allowed >> i & 1 && has(i, properties)) return i;
    return std::nullopt;
  }
  bool has(std::uint32_t type, VkMemoryPropertyFlags properties) const {
    return (memory_.memoryTypes[type].propertyFlags & properties) == properties;
  }
  std::int64_t largest_allocation() const { return largest_allocation_; }

 private:
  void prepare_device() {
    vk.vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
    VkPhysicalDeviceMaintenance3Properties maintenance{};
    maintenance.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &maintenance;
    vk.vkGetPhysicalDeviceProperties2(physical_, &properties);
    largest_allocation_ = std::int64_t(std::min<VkDeviceSize>(maintenance.maxMemoryAllocationSize, INT64_MAX));
    std::copy_n(properties.properties.limits.maxComputeWorkGroupCount, 3, most_workgroups_);
    most_workgroups_[2] = std::min<std::uint32_t>(most_workgroups_[2], 65535);
    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(Arguments)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    check(vk.vkCreatePipelineLayout(device, &info, nullptr, &layout_), "making a pipeline layout");
  }

  VkPipeline pipeline(const Variant& variant) {
    const std::lock_guard lock(pipelines_mutex_);
    const auto found = pipelines_.find(variant);
    if (found == pipelines_.end()) fail_unprepared();
    return found->second;
  }

  std::unique_ptr<Instance> instance_;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory_{};
  std::int64_t largest_allocation_ = 0;
  std::uint32_t most_workgroups_[3] = {65535, 65535, 65535};
  VkQueue queue_ = VK_NULL_HANDLE;
  std::uint32_t family_ = 0;
  bool is_own_ = false;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  std::mutex queue_mutex_, pipelines_mutex_, staging_mutex_;
  std::map<Variant, VkPipeline> pipelines_;
  std::unique_ptr<Buffer> staging_;
};

Buffer::Buffer(VulkanDriver& driver, std::int64_t bytes, Where where) : driver_(driver) {
  const VulkanFunctions& vk = driver.vk;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = VkDeviceSize(std::max<std::int64_t>(bytes, 16));
  info.usage = usage;
  if (std::int64_t(info.size) > driver.largest_allocation())
    check(VK_ERROR_OUT_OF_DEVICE_MEMORY, "one array is too large for it");
  check(vk.vkCreateBuffer(driver.device, &info, nullptr, &buffer_), "making a buffer");
  const auto fail_with = [&](VkResult result, const char* what) {
    if (result == VK_SUCCESS) return;
    vk.vkDestroyBuffer(driver_.device, buffer_, nullptr);
    if (memory_) vk.vkFreeMemory(driver_.device, memory_, nullptr);
    check(result, what);
  };
  VkMemoryRequirements needs{};
  vk.vkGetBufferMemoryRequirements(driver.device, buffer_, &needs);
  constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                  reached = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                  cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  std::optional<std::uint32_t> type;
  // What the host reads is in its caches; memory of the device that it reaches, but not through them, is read slowly.
  for (const VkMemoryPropertyFlags wanted : where == Where::device
                                                ? std::array{local | reached | cached, local, VkMemoryPropertyFlags{0}}
                                                : std::array{reached | cached, reached, reached})
    if (!type) type = driver.memory_type(needs.memoryTypeBits, wanted);
  if (!type) fail_with(VK_ERROR_OUT_OF_DEVICE_MEMORY, "there is no memory of the right kind");
  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocate.pNext = &flags;
  allocate.allocationSize = needs.size;
  allocate.memoryTypeIndex = *type;
  fail_with(vk.vkAllocateMemory(driver.device, &allocate, nullptr, &memory_), "taking memory");
  fail_with(vk.vkBindBufferMemory(driver.device, buffer_, memory_, 0), "binding memory");
  // The host would read memory of the device slowly that is not in its caches.
  if (!driver.has(*type, where == Where::device ? reached | cached : reached)) return;
  void* mapped = nullptr;
  fail_with(vk.vkMapMemory(driver.device, memory_, 0, VK_WHOLE_SIZE, 0, &mapped), "mapping memory");
  mapped_ = static_cast<std::byte*>(mapped);
}

Buffer::~Buffer() {
  driver_.vk.vkDestroyBuffer(driver_.device, buffer_, nullptr);
  driver_.vk.vkFreeMemory(driver_.device, memory_, nullptr);
}

std::uint64_t Buffer::address() const {
  VkBufferDeviceAddressInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
  info.buffer = buffer_;
  return driver_.vk.vkGetBufferDeviceAddress(driver_.device, &info);
}

class VulkanMemory : public Memory {
 public:
  VulkanMemory(std::shared_ptr<VulkanDriver> driver, std::int64_t bytes)
      : driver_(std::move(driver)), buffer_(*driver_, bytes, Buffer::Where::device) {
    address_ = buffer_.address();
    num_bytes_ = bytes;
  }
  VkBuffer buffer() const { return buffer_.handle(); }
  void write(std::int64_t at, std::span<const std::byte> bytes) override {
    if (buffer_.mapped())
      std::copy(bytes.begin(), bytes.end(), buffer_.mapped() + at);
    else
      driver_->copy(buffer_.handle(), at, const_cast<std::byte*>(bytes.data()), std::ssize(bytes), true);
  }
  void read(std::int64_t at, std::span<std::byte> bytes) const override {
    if (buffer_.mapped())
      std::copy_n(buffer_.mapped() + at, bytes.size(), bytes.begin());
    else
      driver_->copy(buffer_.handle(), at, bytes.data(), std::ssize(bytes), false);
  }

 private:
  std::shared_ptr<VulkanDriver> driver_;
  Buffer buffer_;
};

class VulkanRecording : public Recording {
 public:
  explicit VulkanRecording(std::shared_ptr<VulkanDriver> driver) : driver_(std::move(driver)), commands_(*driver_) {}
  void* handle() const override { return commands_.handle(); }
  void* independent() override { return commands_.handle(); }
  void copy(const Memory& from, Memory& to, std::int64_t bytes) override {
    const VkBufferCopy region{0, 0, VkDeviceSize(bytes)};
    driver_->make_visible(commands_.handle());
    driver_->vk.vkCmdCopyBuffer(commands_.handle(), static_cast<const VulkanMemory&>(from).buffer(),
                                static_cast<const VulkanMemory&>(to).buffer(), 1, &region);
    driver_->make_visible(commands_.handle());
  }
  void submit_and_wait() override {
    driver_->make_visible(commands_.handle());
    commands_.run();
  }

 private:
  std::shared_ptr<VulkanDriver> driver_;
  VulkanDriver::Commands commands_;
};

std::unique_ptr<Memory> VulkanDriver::allocate(std::int64_t bytes) {
  return std::make_unique<VulkanMemory>(shared_from_this(), bytes);
}
std::unique_ptr<Recording> VulkanDriver::begin() { return std::make_unique<VulkanRecording>(shared_from_this()); }

void VulkanDriver::copy(VkBuffer buffer, std::int64_t at, std::byte* bytes, std::int64_t count, bool to_device) {
  const std::lock_guard lock(staging_mutex_);
  if (!staging_) staging_ = std::make_unique<Buffer>(*this, staging_bytes, Buffer::Where::host);
  for (std::int64_t done = 0; done < count; done += staging_bytes) {
    const std::int64_t size = std::min(staging_bytes, count - done);
    if (to_device) std::copy_n(bytes + done, size, staging_->mapped());
    Commands commands(*this);
    const VkBufferCopy region{to_device ? 0 : VkDeviceSize(at + done), to_device ? VkDeviceSize(at + done) : 0,
                              VkDeviceSize(size)};
    vk.vkCmdCopyBuffer(commands.handle(), to_device ? staging_->handle() : buffer,
                       to_device ? buffer : staging_->handle(), 1, &region);
    make_visible(commands.handle());
    commands.run();
    if (!to_device) std::copy_n(staging_->mapped(), size, bytes + done);
  }
}

}  // namespace

std::shared_ptr<Driver> open_vulkan_device(size_t number) {
  std::string missing;
  std::unique_ptr<Instance> instance = make_instance(missing);
  if (!instance) throw InvalidOption(missing);
  const std::vector<Usable> usable = usable_devices(*instance);
  if (number >= usable.size()) throw InvalidOption("the GPU is gone; list the devices again");
  return std::make_shared<VulkanDriver>(std::move(instance), usable[number]);
}

std::shared_ptr<Driver> borrow_vulkan_device(const EngineDevice& engine) {
  return std::make_shared<VulkanDriver>(engine);
}

}  // namespace sublimit::gpu
