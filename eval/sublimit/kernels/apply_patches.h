// SPDX-License-Identifier: Apache-2.0
#pragma once
// The inner loops of a table by patterns, for the widest registers that the machine has.
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/packed_rows.h"

namespace sublimit::kernels {

/// Where numbers lie: channel c of point i at i * point + c * channel.
struct Strides {
  std::int64_t point = 3, channel = 1;
};

/// Patches of one group, one after the other. Lanes stand for rows, so that weights are read as they lie and each
/// control point is read once for many rows.
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

/// @param contract  multiply and add in one rounding where the machine can; else the same bits on every machine
void apply_patches(const Patches<float>& patches, bool contract);
void apply_patches(const Patches<double>& patches, bool contract);

/// Unit vectors of points in space, made while both derivatives are in registers: t along u, n = u x v normalised,
/// b = n x t. All three are zero where u x v vanishes or is not finite. Null: not wanted.
template <class Real>
struct TangentFrames {
  Real *tangents = nullptr, *bitangents = nullptr, *normals = nullptr;
};

/// Derivatives along u and v, and what follows from them.
/// @param along_u, along_v  of 3 channels, alike but for weights and results; a null result is not wanted
/// @param frames  as results of `along_u`, in the same order and with the same strides
void apply_frames(const Patches<float>& along_u, const Patches<float>& along_v, const TangentFrames<float>& frames,
                  bool contract);
void apply_frames(const Patches<double>& along_u, const Patches<double>& along_v, const TangentFrames<double>& frames,
                  bool contract);

/// Kinds of registers that this machine has a loop for, by Highway's numbers; for tests.
std::vector<std::int64_t> targets();
/// From now on the loop for this one is taken; 0: the widest again.
void use_target(std::int64_t target);

}  // namespace sublimit::kernels
