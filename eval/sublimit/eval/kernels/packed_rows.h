// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of a block as kernels hold them in registers.
#include <cstdint>

namespace sublimit {

inline constexpr std::int32_t row_multiple = 16;  // lanes of the widest registers

/// The rows that patches use of `row_multiple` packed rows. Members have no defaults: kernels make arrays of them,
/// which would be filled twice.
struct PackedRows {
  std::int32_t first;   ///< the first of the rows, a multiple of `row_multiple`
  std::int32_t to;      ///< point of a patch that the first used row makes; the others follow
  std::uint32_t taken;  ///< bit i: row first + i is used; never zero
};

}  // namespace sublimit
