// SPDX-License-Identifier: Apache-2.0
#pragma once
// Inner loops of tables by patterns, for the widest registers of the machine.
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/eval/kernels/packed_rows.h"

namespace sublimit::kernels {

/// Strides of an array: channel c of point i is number i * point + c * channel.
struct Strides {
  std::int64_t point = 3, channel = 1;
};

/// Consecutive patches of one group. Lanes are rows: weights are read in order, and each control point once for many
/// rows.
template <class Real>
struct Patches {
  const Real* weights = nullptr;  ///< column after column, each of `stride` rows
  std::int64_t stride = 0;
  std::span<const PackedRows> rows;  ///< places ascend; all together make `num_rows` points
  std::int32_t columns = 0, num_rows = 0;
  const std::int32_t* control_points = nullptr;  ///< `columns` for each patch
  std::int64_t count = 0;
  const Real* points = nullptr;
  Strides in;
  Real* result = nullptr;  ///< `num_rows` points for each patch
  Strides out;
  const std::int64_t* patch_points = nullptr;  ///< if given: where those of each patch begin, counted from `result`
  int channels = 3;
};

/// Makes the points of patches.
/// @param contract  true: fuse products and sums where the machine can; false: the same bits on every machine
void apply_patches(const Patches<float>& patches, bool contract);
void apply_patches(const Patches<double>& patches, bool contract);

/// Arrays of tangent frames of points in space: unit vectors t along u, n = u x v normalised, b = n x t. All three are
/// zero where u x v vanishes or is not finite. Null: not wanted.
template <class Real>
struct TangentFrames {
  Real *tangents = nullptr, *bitangents = nullptr, *normals = nullptr;
};

/// Makes derivatives along u and v, and tangent frames from them.
/// @param along_u, along_v  3 channels, equal except for weights and results; a null result is not wanted
/// @param frames  arrays with the order and strides of the results of `along_u`
void apply_frames(const Patches<float>& along_u, const Patches<float>& along_v, const TangentFrames<float>& frames,
                  bool contract);
void apply_frames(const Patches<double>& along_u, const Patches<double>& along_v, const TangentFrames<double>& frames,
                  bool contract);

/// Returns the kinds of registers that this machine has a loop for, by Highway's numbers; for tests.
std::vector<std::int64_t> targets();
/// Selects the loop for one kind of registers; 0: the widest.
void use_target(std::int64_t target);

}  // namespace sublimit::kernels
