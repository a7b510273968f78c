// SPDX-License-Identifier: Apache-2.0
#pragma once
// Transposed blocks times values of patches. Lanes stand for columns, so that each column is a sum over rows in order,
// whatever the width of registers.
#include <array>
#include <cstdint>
#include <span>

namespace sublimit::kernels {

/// Patches of one group, one after the other.
template <class Real>
struct TransposedPatches {
  int quantities = 1;
  std::array<const Real*, 6> weights{};  ///< of each quantity, row by row, of `columns` each
  std::array<const Real*, 6> values{};   ///< of each quantity: those of all points of the table, interleaved
  std::int32_t columns = 0;
  std::span<const std::int32_t> rows;  ///< of the block, in the order of a patch's points
  std::int64_t count = 0;
  std::int64_t first_point = 0;                ///< of the first patch
  const std::int64_t* patch_points = nullptr;  ///< if given: first point of each patch
  Real* result = nullptr;                      ///< count x columns x channels
  int channels = 3;
};

/// @param contract  as in `apply_patches`
void transpose_patches(const TransposedPatches<float>& patches, bool contract);
void transpose_patches(const TransposedPatches<double>& patches, bool contract);

}  // namespace sublimit::kernels
