// SPDX-License-Identifier: Apache-2.0
// Points of patches: chosen rows of a block times the control points that a patch names.
//
// A workgroup makes a tile, some rows of some patches of one group. A thread has `ROWS` rows, which are a vector of the
// weights, of `PATCHES` patches, so that what it reads is used several times. Weights come through the first cache, which
// tiles of the same group find them in; control points are gathered into shared memory, some columns at a time.
#include "language.inc"
#include "vectors.inc"

const int STAGE = THREADS * ROWS * PATCHES > 256 ? THREADS * ROWS * PATCHES : 256;
SHARED_VECTORS(stage, STAGE);

KERNEL(apply_patches) {
  if (WORKGROUP >= arguments.count) return;
  const PatchTable table = PatchTables(arguments.table).at[0];
  const Tile tile = Tiles(table.tiles).at[WORKGROUP];
  const Group group = Groups(table.groups).at[tile.group];
  const ADDRESS points = advanced(arguments.points, FRAME, arguments.in_frame * 4u);
  const bool is_rational = arguments.channels >= 65536u;

  const uint units = (tile.num_rows + uint(ROWS) - 1u) / uint(ROWS), slots = uint(THREADS) / units;
  const uint unit_row = LANE % units * uint(ROWS), slot = LANE / units;

  float sums[QUANTITIES * PATCHES * ROWS * CHANNELS];
#define SUM(q, p, r, c) sums[(((q) * PATCHES + (p)) * ROWS + (r)) * CHANNELS + (c)]
  UNROLL for (int i = 0; i < QUANTITIES * PATCHES * ROWS * CHANNELS; ++i) sums[i] = 0.0f;

  const uint at_once = min(group.num_columns, uint(STAGE) / tile.num_patches);
  for (uint first = 0u; first < group.num_columns; first += at_once) {
    const uint count = min(at_once, group.num_columns - first);
    BARRIER;
    for (uint i = LANE; i < tile.num_patches * count; i += uint(THREADS)) {
      const uint own = i / count, column = first + i - own * count;
      const uint point =
          Numbers(table.columns).at[group.columns + (tile.first_patch + own) * group.num_columns + column];
      const uint at = point * arguments.in_point + (arguments.channels & 255u) * arguments.in_channel;
      vec4 x = vec4(Floats(points).at[at], 0.0f, 0.0f, 0.0f);
      if (CHANNELS > 1) x.y = Floats(points).at[at + arguments.in_channel];
      if (CHANNELS > 2) x.z = Floats(points).at[at + 2u * arguments.in_channel];
      if (CHANNELS > 3) x.w = Floats(points).at[at + 3u * arguments.in_channel];
      if (is_rational) {
        const float w = Floats(points).at[point * arguments.in_point + (arguments.channels >> 8 & 255u) * arguments.in_channel];
        if (CHANNELS == 2) x.y = w;
        if (CHANNELS == 3) x.z = w;
        if (CHANNELS == 4) x.w = w;
      }
      stage[i] = x;
    }
    BARRIER;
    if (slot < slots) {
      uint at_weights = 4u * (group.weights + first * group.stride) + tile.first_row + unit_row;
      for (uint k = 0u; k < count; ++k, at_weights += 4u * group.stride) {
        vec4 x[PATCHES];
        UNROLL for (int p = 0; p < PATCHES; ++p)
          x[p] = stage[min(slot + uint(p) * slots, tile.num_patches - 1u) * count + k];
        UNROLL for (int q = 0; q < QUANTITIES; ++q) {
          const uint at = at_weights + uint(q) * 4u * group.quantity;
          vec4 w = vec4(0.0f, 0.0f, 0.0f, 0.0f);
          if (ROWS == 4) w = Vectors(table.weights).at[at >> 2];
          if (ROWS < 4) w.x = Floats(table.weights).at[at];
          if (ROWS == 2) w.y = Floats(table.weights).at[at + 1u];
          UNROLL for (int p = 0; p < PATCHES; ++p) UNROLL for (int r = 0; r < ROWS; ++r)
            UNROLL for (int c = 0; c < CHANNELS; ++c)
              SUM(q, p, r, c) = fma(COMPONENT(w, r), COMPONENT(x[p], c), SUM(q, p, r, c));
        }
      }
    }
  }

  const uint num_made = tile.num_patches * tile.num_rows;
  const bool is_placed = !IS_NULL(table.patch_points);
  const bool is_run = !is_placed && tile.num_rows == group.num_rows;
  const uint run = group.first_point + tile.first_patch * group.num_rows;
#define has_point(p, r) \
  (slot < slots && slot + uint(p) * slots < tile.num_patches && unit_row + uint(r) < tile.num_rows)
#define place(p, r) ((slot + uint(p) * slots) * tile.num_rows + unit_row + uint(r))
#define address_of(i)                                                                                            \
  ((is_placed ? Numbers(table.patch_points).at[group.first_patch + tile.first_patch + (i) / tile.num_rows]       \
              : run + (i) / tile.num_rows * group.num_rows) + tile.first_row + (i) % tile.num_rows)
#include "finish.inc"
}
