// SPDX-License-Identifier: Apache-2.0
#pragma once
// The transpose of a table in the layout that kernels read.
#include "sublimit/eval/gpu/detail/table_image.h"

namespace sublimit::gpu {

/// A packed transpose. Sums are gathered in a fixed order and have the same bits at each run.
struct PackedTranspose {
  Part fold;     ///< adds values at copies to their points; absent: values are used in place
  Part patches;  ///< tiles of columns of patches
  Part inputs;   ///< sums for the points that patches and rows are applied to
  Part first;    ///< sums for control points, if these differ from the inputs
  std::int64_t num_parts = 0;
  Image image;

  /// Packs the transpose of a table.
  /// @throws ResourceError  more entries than 32-bit numbers count
  explicit PackedTranspose(const PatternTable<float>& table);
};

}  // namespace sublimit::gpu
