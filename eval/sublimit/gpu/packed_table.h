// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table as kernels read it: weights by fours of rows, tiles of patches, rows side by side.
#include <array>

#include "sublimit/gpu/table_image.h"

namespace sublimit::gpu {

/// What a thread of `apply_patches` makes.
struct Shape {
  int rows = 1, patches = 1;
};
/// Of many patches that have rows by fours, and of others.
/// @param quantities  made together: 1, 3 or 6
constexpr Shape shape_of(int quantities, bool many) {
  if (!many) return {1, 1};
  return {4, quantities == 1 ? 2 : 1};
}

struct PackedTable {
  /// Tiles of few patches and of many, for 1, 3 and 6 quantities.
  std::array<std::array<Part, 2>, 3> patches;
  Part first, rest, copies;
  Image image;

  /// @throws ResourceError     more entries than 32-bit numbers count
  /// @throws InvalidParameter  a copy of a point that is written after it
  explicit PackedTable(const PatternTable<float>& table);
};

}  // namespace sublimit::gpu
