// SPDX-License-Identifier: Apache-2.0
#pragma once
// The interface of devices that evaluators use, for Vulkan and CUDA.
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sublimit/eval/gpu/detail/kernel_arguments.h"
#include "sublimit/eval/gpu/gpu_device.h"

namespace sublimit::gpu {

enum class Kernel : std::uint8_t {
  apply_patches,
  apply_rows,
  copy_points,
  transpose_patches,
  gather_parts,
  fold_copies
};
inline constexpr int num_kernels = 6;

/// A kernel with its compile-time parameters.
struct Variant {
  Kernel kernel = Kernel::apply_patches;
  bool half = false;  ///< true if results are half floats
  int quantities = 1, channels = 3;
  int rows = 1, patches = 1;  ///< rows and patches of each thread
  auto operator<=>(const Variant&) const = default;
};

struct Launch {
  Variant variant;
  Arguments arguments;
  std::int64_t workgroups = 0;
  int frames = 1;
  bool waits = false;  ///< true if it reads results of previous launches
};

// Errors of a device.
[[noreturn]] void fail_without_memory(const std::string& what);  ///< ResourceError
[[noreturn]] void fail_lost(const std::string& what);            ///< IoError
[[noreturn]] void fail_otherwise(const std::string& what);       ///< IoError
[[noreturn]] void fail_unprepared();                             ///< InvalidParameter

class Memory {
 public:
  virtual ~Memory() = default;
  virtual void write(std::int64_t at, std::span<const std::byte> bytes) = 0;
  virtual void read(std::int64_t at, std::span<std::byte> bytes) const = 0;
  std::uint64_t address() const { return address_; }
  std::int64_t num_bytes() const { return num_bytes_; }

 protected:
  std::uint64_t address_ = 0;
  std::int64_t num_bytes_ = 0;
};

/// Commands being recorded, by one thread.
class Recording {
 public:
  virtual ~Recording() = default;
  virtual void* handle() const = 0;
  /// Returns a handle for commands that need not wait for those recorded before.
  virtual void* independent() = 0;
  virtual void copy(const Memory& from, Memory& to, std::int64_t bytes) = 0;
  virtual void submit_and_wait() = 0;
};

class Driver {
 public:
  virtual ~Driver() = default;
  const GpuInfo& info() const { return info_; }
  /// @param bytes  may be 0
  virtual std::unique_ptr<Memory> allocate(std::int64_t bytes) = 0;
  virtual std::unique_ptr<Recording> begin() = 0;
  /// Compiles a variant. To be called before `record`, which neither compiles nor allocates.
  virtual void prepare(const Variant& variant) = 0;
  /// @param commands  VkCommandBuffer or CUstream
  /// @throws InvalidParameter  a variant that was not prepared
  virtual void record(void* commands, const Launch& launch) = 0;

 protected:
  GpuInfo info_;
};

/// Usable devices of a library.
struct Found {
  std::vector<GpuInfo> devices;
  std::string missing;  ///< why there is none
};

}  // namespace sublimit::gpu
