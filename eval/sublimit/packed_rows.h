// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of a block in registers.
#include <cstdint>

namespace sublimit {

inline constexpr std::int32_t row_multiple = 16;  // lanes of the widest registers

/// What patches take of `row_multiple` rows of packed weights. Without defaults: kernels keep many in registers'
/// widths, and would fill them twice.
struct PackedRows {
  std::int32_t first;   ///< the first of the rows, a multiple of `row_multiple`
  std::int32_t to;      ///< where the first row that is taken goes, among the points of a patch; the others follow
  std::uint32_t taken;  ///< bit i: row first + i is taken; never zero
};

}  // namespace sublimit
