// SPDX-License-Identifier: Apache-2.0
#pragma once
// The inner loop of a table by patterns, for the widest registers that the machine has.
#include <cstdint>
#include <vector>

namespace sublimit::kernels {

/// Lanes stand for rows, so that weights are read as they lie and each control point is read once for many rows.
template <class Real>
struct Patches {
  const Real* weights = nullptr;  ///< column after column, each of `stride` rows
  std::int32_t columns = 0, rows = 0;
  std::int32_t stride = 0;  ///< `rows` rounded up to a multiple of `row_multiple`; the rest is zero
  const std::int32_t* control_points = nullptr;  ///< `columns` for each patch
  std::int64_t count = 0;
  const Real* points = nullptr;
  Real* result = nullptr;                      ///< `rows` points for each patch
  const std::int64_t* patch_points = nullptr;  ///< if given: where those of each patch begin, counted from `result`
  int channels = 3;                            ///< of points and result, interleaved
};
inline constexpr std::int32_t row_multiple = 16;  // lanes of the widest registers

/// @param contract  multiply and add in one rounding where the machine can; else the same bits on every machine
void apply_patches(const Patches<float>& patches, bool contract);
void apply_patches(const Patches<double>& patches, bool contract);

/// Kinds of registers that this machine has a loop for, by Highway's numbers; for tests.
std::vector<std::int64_t> targets();
/// From now on the loop for this one is taken; 0: the widest again.
void use_target(std::int64_t target);

}  // namespace sublimit::kernels
