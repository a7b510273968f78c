// SPDX-License-Identifier: Apache-2.0
#pragma once
// The transpose of a table as kernels read it.
#include "sublimit/gpu/table_image.h"

namespace sublimit::gpu {

/// The same for the transpose: sums are gathered in a fixed order, so that they have the same bits whenever they are
/// made.
struct PackedTranspose {
  Part fold;     ///< copies; none: values are used where they are
  Part patches;  ///< tiles of columns of patches
  Part inputs;   ///< of patches and rows
  Part first;    ///< control points, if inputs are none
  std::int64_t num_parts = 0;
  Image image;

  /// @throws ResourceError  more entries than 32-bit numbers count
  explicit PackedTranspose(const PatternTable<float>& table);
};

}  // namespace sublimit::gpu
