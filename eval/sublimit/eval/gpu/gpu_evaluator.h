// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables on GPUs, in float: from and to main memory, or on arrays of the device.
//
//   const GpuDevice device(0);
//   const auto& baked = std::get<BakedTable<float>>(table.baked());  // table: a Table of eval/table.h
//   const GpuEvaluator evaluator(baked.table, device);
//   evaluator.apply(points, 3, result);  // result: std::vector<float>(table.num_results(3))
#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "sublimit/eval/evaluate/evaluation.h"
#include "sublimit/eval/gpu/gpu_device.h"
#include "sublimit/eval/table/pattern_table.h"

namespace sublimit {

/// An evaluation on arrays of the device. Fields are those of `Evaluation`, with addresses on the device
/// (vkGetBufferDeviceAddress, CUdeviceptr) instead of spans; 0: not wanted. Addresses are multiples of four bytes,
/// those of `scratch` and of transposes multiples of eight.
struct GpuEvaluation {
  int channels = 3;                                         ///< channels of points and results
  int frames = 1;                                           ///< sets of points
  std::uint64_t points = 0;                                 ///< control points of all frames
  PointLayout point_layout;                                 ///< layout of `points`
  std::array<std::uint64_t, 6> quantities = {};             ///< position, derivatives along u, v, uu, uv, vv
  std::uint64_t tangents = 0, bitangents = 0, normals = 0;  ///< unit vectors t, n x t, n
  PointLayout result_layout;                                ///< layout of results, in numbers of their type
  bool rational = false;                                    ///< the last channel is a weight, see `Evaluation`
  float least_weight = 0;                                   ///< largest magnitude of a weight that counts as zero
  bool halves = false;  ///< results are half floats, rounded to nearest; needs `GpuInfo::halves`
  /// `num_scratch_bytes` bytes, used until the recorded commands have run.
  std::uint64_t scratch = 0;
};

/// A transpose on arrays of the device, see `PatternEvaluator::apply_transpose`.
struct GpuTranspose {
  int channels = 3;           ///< channels of values and result
  int quantities = 1;         ///< quantities of `values`: the first ones of the table
  std::uint64_t values = 0;   ///< quantities x num_points x channels, interleaved
  std::uint64_t result = 0;   ///< num_control_points x channels; overwritten
  std::uint64_t scratch = 0;  ///< `num_scratch_bytes` bytes, used until the recorded commands have run
};

/// A table on a GPU: uploaded once, applied many times. Any number of threads may use it at once; it must exist until
/// all recorded commands have run. On one device results always have the same bits; they differ from those of
/// `PatternEvaluator<float>` by rounding.
class GpuEvaluator {
 public:
  /// Packs and uploads a table.
  /// @param table  must outlive the evaluator
  /// @throws ResourceError     no memory left on the device, or more than 2^31 - 1 points, weights or columns
  /// @throws IoError           the device is lost
  /// @throws InvalidParameter  a table that copies a point before it is written, or has a point that nothing writes
  GpuEvaluator(const PatternTable<float>& table, const GpuDevice& device);
  GpuEvaluator(const PatternTable<float>&&, const GpuDevice&) = delete;
  ~GpuEvaluator();
  GpuEvaluator(GpuEvaluator&&) noexcept;

  const PatternTable<float>& table() const;
  std::int64_t num_bytes() const;  ///< memory of the table on the device, without lists of the transpose

  // From and to main memory. Memory on the device is kept for the next call.

  /// Makes all quantities of one frame, as `PatternEvaluator<float>::apply`.
  /// @throws InvalidParameter  as `PatternEvaluator::apply`
  void apply(std::span<const float> points, int channels, std::span<float> result) const;
  /// Makes the results that an evaluation asks for.
  /// @throws InvalidParameter  as `PatternEvaluator::apply`
  void apply(const Evaluation<float>& evaluation) const;
  /// Applies the transpose, as `PatternEvaluator<float>::apply_transpose`.
  /// @throws InvalidParameter  as `PatternEvaluator::apply_transpose`
  /// @note  The first call uploads lists as large as the table's columns, which stay on the device.
  void apply_transpose(std::span<const float> values, int channels, std::span<float> result) const;

  // On arrays of the device. Call `prepare` once for evaluations with the same channels, wanted quantities and type of
  // results; `record` then neither allocates nor waits. The caller synchronises: points must be written before, and
  // results read only after, the recorded commands (in Vulkan: barriers to and from
  // VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, shader read and shader write). Commands of several evaluations may run at the
  // same time.

  /// Checks an evaluation and compiles its kernels.
  /// @throws InvalidParameter  as `apply`; an address that is not a multiple of four; scratch that is missing
  /// @throws ResourceError     strides of 2^30 numbers or more, frames of points of more than 2^31 numbers
  void prepare(const GpuEvaluation& evaluation) const;
  /// Returns the size of `scratch` that an evaluation needs; 0: none.
  std::int64_t num_scratch_bytes(const GpuEvaluation& evaluation) const;
  /// Records an evaluation into a command buffer of Vulkan: binds pipelines and writes push constants.
  /// @param commands  being recorded, of the queue's family, outside of render passes
  /// @throws InvalidParameter  an evaluation that was not prepared; and as `prepare`
  /// @throws ResourceError     more workgroups than the device takes at once: record the command buffer anew
  void record(VkCommandBuffer_T* commands, const GpuEvaluation& evaluation) const;
  /// Enqueues an evaluation in a stream of CUDA.
  /// @param stream  of the primary context of the device; null: the default stream
  /// @throws as above
  void record(CUstream_st* stream, const GpuEvaluation& evaluation) const;
  /// Records an evaluation.
  /// @throws as above
  void record(const GpuCommands& commands, const GpuEvaluation& evaluation) const;

  /// Checks a transpose, uploads its lists if they are not on the device yet, and compiles its kernels.
  /// @throws as `prepare` of an evaluation
  void prepare(const GpuTranspose& transpose) const;
  /// Returns the size of `scratch` that a transpose needs; 0: none.
  std::int64_t num_scratch_bytes(const GpuTranspose& transpose) const;
  /// Records a transpose into a command buffer of Vulkan.
  /// @throws as `record` of an evaluation
  void record(VkCommandBuffer_T* commands, const GpuTranspose& transpose) const;
  /// Enqueues a transpose in a stream of CUDA.
  /// @throws as `record` of an evaluation
  void record(CUstream_st* stream, const GpuTranspose& transpose) const;
  /// Records a transpose.
  /// @throws as `record` of an evaluation
  void record(const GpuCommands& commands, const GpuTranspose& transpose) const;

 private:
  struct Uploaded;
  std::unique_ptr<Uploaded> uploaded_;
};

}  // namespace sublimit
