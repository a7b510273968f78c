// SPDX-License-Identifier: Apache-2.0
// Values of positions, each copy's added to what it copies.
#include "language.inc"

KERNEL(fold_copies) {
  const uint i = WORKGROUP * uint(THREADS) + LANE;
  if (i >= arguments.count) return;
  const FoldTable table = FoldTables(arguments.table).at[0];
  const uint begin = Numbers(table.offsets).at[i], end = Numbers(table.offsets).at[i + 1u];
  const ADDRESS to = advanced(arguments.results[0], i, 4u * arguments.in_point);
  for (uint c = 0u; c < arguments.in_point; ++c) {
    float sum = 0.0f;
    for (uint k = begin; k < end; ++k)
      sum += Floats(advanced(arguments.results[1], Numbers(table.points).at[k], 4u * arguments.in_point)).at[c];
    WrittenFloats(to).at[c] = sum;
  }
}
