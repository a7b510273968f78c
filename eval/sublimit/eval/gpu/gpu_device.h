// SPDX-License-Identifier: Apache-2.0
#pragma once
// GPUs that apply tables: those of this machine, without a window, or the Vulkan device of an engine.
//
//   for (const GpuInfo& gpu : gpu_devices()) std::cout << gpu.name << ", " << name(gpu.api) << "\n";
//   const GpuDevice device(0);
//   GpuBuffer points(device, 3 * sizeof(float) * num_control_points);
//   points.write(std::as_bytes(std::span(frame)));  // frame: std::vector<float>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

// Handles of Vulkan and CUDA, declared as in their headers, which are not needed here.
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

/// Interface through which a device is used.
enum class GpuApi { vulkan, cuda };
/// Returns "Vulkan" or "CUDA".
const char* name(GpuApi api);

/// Kind of a device, in the order in which `gpu_devices` lists them.
enum class GpuKind { discrete, integrated, virtual_machine, cpu };
/// Returns "discrete", "integrated", "virtual" or "cpu".
const char* name(GpuKind kind);

/// Properties of a device.
struct GpuInfo {
  std::string name;                  ///< "NVIDIA H100", "llvmpipe (LLVM 15.0.6, 256 bits)"
  GpuApi api = GpuApi::vulkan;       ///< interface
  GpuKind kind = GpuKind::discrete;  ///< kind
  std::string driver;                ///< name and version of the driver
  std::int64_t memory = 0;           ///< bytes of the largest heap on the device
  bool halves = false;               ///< true if results can be half floats
};

/// Returns the devices of this machine that can apply tables: discrete ones first, CPUs that emulate a GPU last. They
/// are devices of CUDA, and of Vulkan 1.2 with buffer device addresses.
/// @param why_none  if given, and there is no device: set to what is missing
std::vector<GpuInfo> gpu_devices(std::string* why_none = nullptr);

/// The Vulkan device of an engine, which keeps owning it. Pipelines and buffers of tables are created on it; calls that
/// copy from or to main memory also create a buffer of 32 MB, and temporarily a command pool and a fence.
struct EngineDevice {
  VkInstance_T* instance = nullptr;
  VkPhysicalDevice_T* physical_device = nullptr;
  VkDevice_T* device = nullptr;  ///< Vulkan 1.2 or later, with the feature bufferDeviceAddress enabled
  /// Queue with compute. Used by calls that upload tables and by `apply` of spans, during which the engine must not use
  /// it; recording does not use it. Make one `GpuDevice` for each queue.
  VkQueue_T* queue = nullptr;
  std::uint32_t queue_family = 0;  ///< family of the queue and of the command buffers that are recorded into
  bool halves = false;             ///< true if the feature storageBuffer16BitAccess is enabled
  /// vkGetInstanceProcAddr of the engine; null: that of the Vulkan loader, which is searched for.
  void (*(*get_instance_proc_addr)(VkInstance_T*, const char*))() = nullptr;
};

/// A device. Copies refer to the same device, which lives as long as anything that was made with it. Any number of
/// threads may use it.
class GpuDevice {
 public:
  /// Opens a device of this machine.
  /// @param number  index into `gpu_devices()`
  /// @throws InvalidOption           there is no such device: the message says what is missing
  /// @throws ResourceError, IoError  no memory left on the device, the device is lost; as all calls that use a device
  explicit GpuDevice(int number = 0);
  /// Uses the device of an engine.
  /// @throws InvalidParameter  a handle is missing
  /// @throws IoError           the device does not have Vulkan 1.2
  explicit GpuDevice(const EngineDevice& engine);

  const GpuInfo& info() const;  ///< properties of the device
  /// Returns the internal interface to the device.
  const std::shared_ptr<gpu::Driver>& driver() const { return driver_; }

 private:
  std::shared_ptr<gpu::Driver> driver_;
};

/// An array in the memory of a device. Engines can pass addresses of their own buffers instead. To be used by one
/// thread at a time.
class GpuBuffer {
 public:
  /// Allocates an array.
  /// @throws InvalidParameter  a negative size;  ResourceError  no memory left
  GpuBuffer(const GpuDevice& device, std::int64_t bytes);
  ~GpuBuffer();
  GpuBuffer(GpuBuffer&&) noexcept;
  GpuBuffer& operator=(GpuBuffer&&) noexcept;

  std::uint64_t address() const;   ///< address on the device, for `GpuEvaluation` and `GpuTranspose`
  std::int64_t num_bytes() const;  ///< size
  /// Returns the internal interface to the memory.
  gpu::Memory& memory() const { return *memory_; }
  /// Copies from main memory to the bytes from `at` on, and waits.
  /// @throws InvalidParameter  a range beyond the end
  void write(std::span<const std::byte> bytes, std::int64_t at = 0);
  /// Copies the bytes from `at` on to main memory, and waits.
  /// @throws InvalidParameter  a range beyond the end
  void read(std::span<std::byte> bytes, std::int64_t at = 0) const;

 private:
  std::unique_ptr<gpu::Memory> memory_;
};

/// Commands for a device of this machine: recorded by evaluators, then submitted once. With CUDA they start as soon as
/// they are recorded. To be used by one thread.
class GpuCommands {
 public:
  /// Begins recording.
  explicit GpuCommands(const GpuDevice& device);
  ~GpuCommands();
  GpuCommands(GpuCommands&&) noexcept;

  /// Returns the VkCommandBuffer or CUstream. Commands in a CUstream run one after the other.
  void* handle() const;
  /// Returns the internal interface to the recording.
  gpu::Recording& recording() const { return *recording_; }
  /// Records a copy on the device, which runs after the commands before it and before those that follow.
  /// @throws InvalidParameter  more bytes than one of the buffers has
  void copy(const GpuBuffer& from, GpuBuffer& to, std::int64_t bytes) const;
  /// Submits the commands, and waits until they have run.
  void submit_and_wait();

 private:
  std::unique_ptr<gpu::Recording> recording_;
};

}  // namespace sublimit
