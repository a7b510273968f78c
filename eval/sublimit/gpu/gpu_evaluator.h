// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table by patterns on a GPU, in float.
#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "sublimit/evaluation.h"
#include "sublimit/gpu/gpu_device.h"
#include "sublimit/pattern_table.h"

namespace sublimit {

/// As `Evaluation`, of numbers in the memory of the device: addresses of buffers (vkGetBufferDeviceAddress,
/// CUdeviceptr) instead of spans; 0 is not wanted. Multiples of four bytes, of scratch and transposes of eight.
struct GpuEvaluation {
  int channels = 3;
  int frames = 1;
  std::uint64_t points = 0;
  PointLayout point_layout;
  std::array<std::uint64_t, 6> quantities = {};
  std::uint64_t tangents = 0, bitangents = 0, normals = 0;
  PointLayout result_layout;  ///< in numbers, whatever they are
  bool rational = false;
  float least_weight = 0;
  bool halves = false;  ///< results are half floats, rounded to nearest; where the device has them, see `GpuInfo`
  /// As many bytes as `num_scratch_bytes` says; of what is recorded until it was run.
  std::uint64_t scratch = 0;
};

/// What `PatternEvaluator::apply_transpose` takes, in the memory of the device.
struct GpuTranspose {
  int channels = 3;
  int quantities = 1;        ///< that `values` has, the first ones of the table's
  std::uint64_t values = 0;  ///< quantities x num_points x channels, interleaved
  std::uint64_t result = 0;  ///< num_control_points x channels; overwritten
  std::uint64_t scratch = 0;
};

/// Prepared once, applied many times, by any number of threads at once; it must stay until all that was recorded has
/// run. What is made has the same bits whenever it is made on one device, and is what `PatternEvaluator<float>` makes
/// to rounding.
class GpuEvaluator {
 public:
  /// Packs and uploads the table.
  /// @param table  which must stay
  /// @throws ResourceError     no memory left on the device, or a table of more than 2^31 - 1 points, weights or
  /// columns
  /// @throws IoError           the device is lost
  /// @throws InvalidParameter  a table that copies a point and writes it later, or makes a point nowhere
  GpuEvaluator(const PatternTable<float>& table, const GpuDevice& device);
  GpuEvaluator(const PatternTable<float>&&, const GpuDevice&) = delete;
  ~GpuEvaluator();
  GpuEvaluator(GpuEvaluator&&) noexcept;

  const PatternTable<float>& table() const;
  std::int64_t num_bytes() const;  ///< of the device's memory that the table takes, but for its transpose

  /// Of the host's numbers: as `PatternEvaluator<float>::apply`. Memory on the device is kept from call to call.
  /// @throws InvalidParameter  as there
  void apply(std::span<const float> points, int channels, std::span<float> result) const;
  void apply(const Evaluation<float>& evaluation) const;
  /// @note  The first call uploads lists as large as the table's columns, which stay.
  void apply_transpose(std::span<const float> values, int channels, std::span<float> result) const;

  // Of numbers that are on the device. `prepare` once, for an evaluation with the same quantities wanted, channels and
  // kind of results; `record` then neither allocates nor waits. Who records sees to it that points are there before,
  // and that nobody reads results before they are (of Vulkan: from and to VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, shader
  // read and shader write); what is recorded for several evaluations may run at the same time.

  /// Checks, compiles kernels.
  /// @throws InvalidParameter  as `apply`; an address that is not a multiple of four; no scratch
  /// @throws ResourceError     strides of 2^30 numbers or more, frames of points of more than 2^31
  void prepare(const GpuEvaluation& evaluation) const;
  std::int64_t num_scratch_bytes(const GpuEvaluation& evaluation) const;
  /// @param commands  that are being recorded, for the queue's family, outside of render passes; binds a pipeline and
  /// writes
  ///                  push constants
  /// @throws InvalidParameter  what was not prepared, as `prepare`
  /// @throws ResourceError     more workgroups than the device takes at once: commands are to be recorded anew
  void record(VkCommandBuffer_T* commands, const GpuEvaluation& evaluation) const;
  /// @param stream  of the primary context of the device; may be null, the default stream
  void record(CUstream_st* stream, const GpuEvaluation& evaluation) const;
  void record(const GpuCommands& commands, const GpuEvaluation& evaluation) const;

  void prepare(const GpuTranspose& transpose) const;
  std::int64_t num_scratch_bytes(const GpuTranspose& transpose) const;
  void record(VkCommandBuffer_T* commands, const GpuTranspose& transpose) const;
  void record(CUstream_st* stream, const GpuTranspose& transpose) const;
  void record(const GpuCommands& commands, const GpuTranspose& transpose) const;

 private:
  struct Uploaded;
  std::unique_ptr<Uploaded> uploaded_;
};

}  // namespace sublimit
