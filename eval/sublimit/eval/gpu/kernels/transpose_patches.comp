// SPDX-License-Identifier: Apache-2.0
// What the columns of patches get: transposed blocks times the values of points. A thread sums what one column of one
// patch gets, row after row.
#include "language.inc"

KERNEL(transpose_patches) {
  if (WORKGROUP >= arguments.count) return;
  const TransposeTable table = TransposeTables(arguments.table).at[0];
  const Items items = ItemLists(table.items).at[WORKGROUP];
  const Group group = Groups(table.groups).at[items.group];
  const uint first_channel = arguments.channels;
  for (uint i = LANE; i < items.count; i += uint(THREADS)) {
    const uint item = items.first + i, own = item / group.num_columns, column = item - own * group.num_columns;
    const uint point = IS_NULL(table.patch_points) ? group.first_point + own * group.num_rows
                                                   : Numbers(table.patch_points).at[group.first_patch + own];
    float sums[CHANNELS];
    UNROLL for (int c = 0; c < CHANNELS; ++c) sums[c] = 0.0f;
    ADDRESS values = arguments.results[1];
    for (uint q = 0u; q < arguments.quantities; ++q) {
      const ADDRESS from = advanced(q == 0u ? arguments.results[0] : values, point, 4u * arguments.in_point);
      const uint weights = group.weights + (q * group.num_columns + column) * group.stride;
      for (uint r = 0u; r < group.num_rows; ++r) {
        const float w = Floats(table.weights).at[weights + r];
        UNROLL for (int c = 0; c < CHANNELS; ++c)
          sums[c] = fma(w, Floats(from).at[r * arguments.in_point + first_channel + uint(c)], sums[c]);
      }
      values = advanced(values, arguments.out_frame, 4u * arguments.in_point);
    }
    const ADDRESS to = advanced(arguments.results[2], group.columns + item, 4u * arguments.in_point);
    UNROLL for (int c = 0; c < CHANNELS; ++c) WrittenFloats(to).at[first_channel + uint(c)] = sums[c];
  }
}
