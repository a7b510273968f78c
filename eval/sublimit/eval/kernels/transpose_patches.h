// SPDX-License-Identifier: Apache-2.0
#pragma once
// Inner loop of transposed blocks times values of patches. Lanes are columns: each column is a sum over rows in order,
// for any width of registers.
#include <array>
#include <cstdint>
#include <span>

namespace sublimit::kernels {

/// Consecutive patches of one group.
template <class Real>
struct TransposedPatches {
  int quantities = 1;
  std::array<const Real*, 6> weights{};  ///< weights of each quantity, row by row, `columns` in each
  std::array<const Real*, 6> values{};   ///< values of each quantity at all points of the table, interleaved
  std::int32_t columns = 0;
  std::span<const std::int32_t> rows;  ///< rows of the block, in the order of a patch's points
  std::int64_t count = 0;
  std::int64_t first_point = 0;                ///< first point of the first patch
  const std::int64_t* patch_points = nullptr;  ///< if given: first point of each patch
  Real* result = nullptr;                      ///< count x columns x channels
  int channels = 3;
};

/// Makes the contributions of patches to their control points.
/// @param contract  as in `apply_patches`
void transpose_patches(const TransposedPatches<float>& patches, bool contract);
void transpose_patches(const TransposedPatches<double>& patches, bool contract);

}  // namespace sublimit::kernels
