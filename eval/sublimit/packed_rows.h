// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of a block in registers.
#include <cstdint>

namespace sublimit {

inline constexpr std::int32_t row_multiple = 16;  // lanes of the widest registers

/// What patches take of `row_multiple` rows of packed weights.
struct PackedRows {
  std::int32_t first = 0;   ///< the first of the rows, a multiple of `row_multiple`
  std::int32_t to = 0;      ///< where the first row that is taken goes, among the points of a patch; the others follow
  std::uint32_t taken = 0;  ///< bit i: row first + i is taken; never zero
};

}  // namespace sublimit
