// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table in the layout that kernels read: weights in groups of four rows, tiles of patches, rows side by side.
#include <array>

#include "sublimit/eval/gpu/detail/table_image.h"

namespace sublimit::gpu {

/// Number of rows and patches of each thread of `apply_patches`.
struct Shape {
  int rows = 1, patches = 1;
};
/// Returns the shape for groups of many patches, whose rows are grouped by four, or for other groups.
/// @param quantities  quantities made together: 1, 3 or 6
constexpr Shape shape_of(int quantities, bool many) {
  if (!many) return {1, 1};
  return {4, quantities == 1 ? 2 : 1};
}

/// A packed table.
struct PackedTable {
  /// Tiles of few patches and of many, for 1, 3 and 6 quantities.
  std::array<std::array<Part, 2>, 3> patches;
  Part first, rest, copies;
  Image image;

  /// Packs a table.
  /// @throws ResourceError     more entries than 32-bit numbers count
  /// @throws InvalidParameter  a point that is copied before it is written
  explicit PackedTable(const PatternTable<float>& table);
};

}  // namespace sublimit::gpu
