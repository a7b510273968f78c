// SPDX-License-Identifier: Apache-2.0
#pragma once
// GPUs that tables are applied on: those of this machine, without a window, or the device that an engine has.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

// Handles of Vulkan and CUDA, as their headers have them; neither is needed here.
struct VkInstance_T;
struct VkPhysicalDevice_T;
struct VkDevice_T;
struct VkQueue_T;
struct VkCommandBuffer_T;
struct CUstream_st;

namespace sublimit {
namespace gpu {
class Driver;
class Memory;
class Recording;
}  // namespace gpu

enum class GpuApi { vulkan, cuda };
const char* name(GpuApi api);  ///< "Vulkan", "CUDA"

/// Kinds in the order in which devices are counted.
enum class GpuKind { discrete, integrated, virtual_machine, cpu };
const char* name(GpuKind kind);  ///< "discrete", "integrated", "virtual", "cpu"

struct GpuInfo {
  std::string name;  ///< "NVIDIA H100", "llvmpipe (LLVM 15.0.6, 256 bits)"
  GpuApi api = GpuApi::vulkan;
  GpuKind kind = GpuKind::discrete;
  std::string driver;       ///< its name and version
  std::int64_t memory = 0;  ///< bytes of the largest heap on the device
  bool halves = false;      ///< results can be half floats
};

/// Devices of this machine that can apply tables, numbered from 0: discrete ones first, CPUs that stand in for a GPU
/// last. Those of Vulkan 1.2 with buffer device addresses, those of CUDA.
/// @param why_none  if given: what is missing, where there is none
std::vector<GpuInfo> gpu_devices(std::string* why_none = nullptr);

/// The Vulkan device of an engine, which stays the engine's. Created are pipelines and buffers of tables; where the
/// host copies or waits, also a buffer of 32 MB for that, and a command pool and a fence for the while.
struct EngineDevice {
  VkInstance_T* instance = nullptr;
  VkPhysicalDevice_T* physical_device = nullptr;
  VkDevice_T* device = nullptr;  ///< Vulkan 1.2 or later, with the feature bufferDeviceAddress on
  /// Takes compute. Used by calls that upload tables and by `apply` of spans, and must not be used by others meanwhile;
  /// recording does not touch it. One `GpuDevice` for each queue.
  VkQueue_T* queue = nullptr;
  std::uint32_t queue_family = 0;  ///< of the queue, and of the commands that are recorded
  bool halves = false;             ///< the feature storageBuffer16BitAccess is on
  /// vkGetInstanceProcAddr of the engine; null: the loader's, which is looked for.
  void (*(*get_instance_proc_addr)(VkInstance_T*, const char*))() = nullptr;
};

/// A device. Copies are the same one; it lives as long as what was made with it. Used by any number of threads.
class GpuDevice {
 public:
  /// @param number  as `gpu_devices` counts
  /// @throws InvalidOption  there is no such device; says what is missing
  /// @throws ResourceError, IoError  as all calls that reach a device: no memory left there, the device is lost
  explicit GpuDevice(int number = 0);
  /// @throws InvalidParameter  a handle is missing
  /// @throws IoError           the device is not of Vulkan 1.2
  explicit GpuDevice(const EngineDevice& engine);

  const GpuInfo& info() const;
  const std::shared_ptr<gpu::Driver>& driver() const { return driver_; }

 private:
  std::shared_ptr<gpu::Driver> driver_;
};

/// Numbers in the memory of a device. Engines need none: addresses of their own buffers do.
class GpuBuffer {
 public:
  /// @throws ResourceError  no memory left
  GpuBuffer(const GpuDevice& device, std::int64_t bytes);
  ~GpuBuffer();
  GpuBuffer(GpuBuffer&&) noexcept;
  GpuBuffer& operator=(GpuBuffer&&) noexcept;

  std::uint64_t address() const;
  std::int64_t num_bytes() const;
  gpu::Memory& memory() const { return *memory_; }
  /// Copies and waits.
  /// @throws InvalidParameter  beyond the end
  void write(std::span<const std::byte> bytes, std::int64_t at = 0);
  void read(std::span<std::byte> bytes, std::int64_t at = 0) const;

 private:
  std::unique_ptr<gpu::Memory> memory_;
};

/// Commands for a device of `gpu_devices`: recorded by evaluators, submitted once; by CUDA they begin when they are
/// recorded. Of one thread.
class GpuCommands {
 public:
  explicit GpuCommands(const GpuDevice& device);
  ~GpuCommands();
  GpuCommands(GpuCommands&&) noexcept;

  /// VkCommandBuffer or CUstream. What is recorded into a CUstream waits for what was recorded there before.
  void* handle() const;
  gpu::Recording& recording() const { return *recording_; }
  /// Copies on the device, after what was recorded before and before what comes after.
  /// @throws InvalidParameter  more bytes than there are
  void copy(const GpuBuffer& from, GpuBuffer& to, std::int64_t bytes) const;
  void submit_and_wait();

 private:
  std::unique_ptr<gpu::Recording> recording_;
};

}  // namespace sublimit
