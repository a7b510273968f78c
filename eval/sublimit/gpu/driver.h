// SPDX-License-Identifier: Apache-2.0
#pragma once
// What evaluators need of a device, whatever it is reached through.
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sublimit/gpu/gpu_device.h"
#include "sublimit/gpu/kernel_arguments.h"

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

/// A kernel for some numbers that are known when it is compiled.
struct Variant {
  Kernel kernel = Kernel::apply_patches;
  bool half = false;  ///< results are half floats
  int quantities = 1, channels = 3;
  int rows = 1, patches = 1;  ///< of a thread
  auto operator<=>(const Variant&) const = default;
};

struct Launch {
  Variant variant;
  Arguments arguments;
  std::int64_t workgroups = 0;
  int frames = 1;
  bool waits = false;  ///< for launches before it
};

// Failures of a device, whatever it is reached through.
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

/// Commands of one thread.
class Recording {
 public:
  virtual ~Recording() = default;
  virtual void* handle() const = 0;
  /// For something that need not wait for what was recorded before.
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
  /// To be called before `record`, which neither compiles nor allocates.
  virtual void prepare(const Variant& variant) = 0;
  /// @param commands  VkCommandBuffer or CUstream
  /// @throws InvalidParameter  a variant that was not prepared
  virtual void record(void* commands, const Launch& launch) = 0;

 protected:
  GpuInfo info_;
};

/// Devices that a driver's library shows, those that cannot be used left out.
struct Found {
  std::vector<GpuInfo> devices;
  std::string missing;  ///< why there is none
};

}  // namespace sublimit::gpu
