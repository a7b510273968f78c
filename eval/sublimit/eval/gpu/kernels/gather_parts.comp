// SPDX-License-Identifier: Apache-2.0
// What inputs get: the sum over columns of patches, and over entries of rows, always in the same order.
#include "language.inc"

KERNEL(gather_parts) {
  const uint i = WORKGROUP * uint(THREADS) + LANE;
  if (i >= arguments.count) return;
  const GatherTable table = GatherTables(arguments.table).at[0];
  const uint first_channel = arguments.channels;
  float sums[CHANNELS];
  UNROLL for (int c = 0; c < CHANNELS; ++c) sums[c] = 0.0f;
  if (!IS_NULL(table.part_offsets)) {
    const uint end = Numbers(table.part_offsets).at[i + 1u];
    for (uint k = Numbers(table.part_offsets).at[i]; k < end; ++k) {
      const ADDRESS from = advanced(arguments.results[2], Numbers(table.parts).at[k], 4u * arguments.in_point);
      UNROLL for (int c = 0; c < CHANNELS; ++c) sums[c] += Floats(from).at[first_channel + uint(c)];
    }
  }
  if (!IS_NULL(table.entry_offsets)) {
    const uint end = Numbers(table.entry_offsets).at[i + 1u];
    for (uint k = Numbers(table.entry_offsets).at[i]; k < end; ++k) {
      const uvec2 entry = Entries(table.entries).at[k];
      if (entry.x >= arguments.quantities * arguments.out_frame) break;  // numbers ascend
      const ADDRESS values = entry.x < arguments.out_frame ? arguments.results[0] : arguments.results[1];
      const ADDRESS from = advanced(values, entry.x, 4u * arguments.in_point);
      UNROLL for (int c = 0; c < CHANNELS; ++c)
        sums[c] = fma(AS_FLOAT(entry.y), Floats(from).at[first_channel + uint(c)], sums[c]);
    }
  }
  const ADDRESS to = advanced(arguments.results[3], i, 4u * arguments.in_point);
  UNROLL for (int c = 0; c < CHANNELS; ++c) WrittenFloats(to).at[first_channel + uint(c)] = sums[c];
}
