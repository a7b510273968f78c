// SPDX-License-Identifier: Apache-2.0
// Points of patches: chosen rows of a block times the control points that a patch names.
//
// A workgroup makes a tile, some rows of some patches of one group. A thread has `ROWS` rows, which are a vector of
// the weights, of `PATCHES` patches, so that what it reads is used several times. Its rows lie `units` apart:
// neighbours write neighbouring points. Weights come through the first cache, where tiles of the same group find them;
// control points are gathered into shared memory, some columns at a time.
#include "language.inc"
#include "vectors.inc"

// Columns that are multiplied at a time, so that their weights are on their way together.
#define COLUMNS (ROWS == 1 ? 8 : 4)
// Vectors in shared memory: as many control points of as many patches as a workgroup may have, or what is made.
#define STAGE (THREADS * PATCHES * COLUMNS)
SHARED_OF_FILE(stage, STAGE + 2);

KERNEL(apply_patches) {
  SHARED_OF_KERNEL(stage, STAGE + 2);
  if (WORKGROUP >= arguments.count) return;
  const PatchTable table = PatchTables(arguments.table).at[0];
  const Tile tile = Tiles(table.tiles).at[WORKGROUP];
  const ADDRESS points = advanced(arguments.points, FRAME, arguments.in_frame * 4u);
  const uint first_channel = arguments.channels & 255u, weight_channel = arguments.channels >> 8 & 255u;
  const bool is_rational = arguments.channels >= 65536u;

  const uint units = (tile.num_rows + uint(ROWS) - 1u) / uint(ROWS), slots = uint(THREADS) / units;
  const uint slot = LANE / units, unit_row = LANE - slot * units;

  float sums[QUANTITIES * PATCHES * ROWS * CHANNELS];
#define SUM(q, p, r, c) sums[(((q) * PATCHES + (p)) * ROWS + (r)) * CHANNELS + (c)]
  UNROLL for (int i = 0; i < QUANTITIES * PATCHES * ROWS * CHANNELS; ++i) sums[i] = 0.0f;

  const uint columns = (tile.num_columns + uint(COLUMNS) - 1u) / uint(COLUMNS) * uint(COLUMNS);
  const uint at_once = min(columns, uint(STAGE) / tile.num_patches / uint(COLUMNS) * uint(COLUMNS));
  for (uint first = 0u; first < columns; first += at_once) {
    const uint count = min(at_once, columns - first);
    BARRIER;
    for (uint i = LANE; i < tile.num_patches * count; i += uint(THREADS)) {
      const uint own = i / count, column = first + i - own * count;
      vec4 x = VEC4(0.0f, 0.0f, 0.0f, 0.0f);
      if (column < tile.num_columns) {
        const uint number = Numbers(table.columns).at[tile.columns + own * tile.num_columns + column];
        const uint point = number * arguments.in_point;
        UNROLL for (int c = 0; c < CHANNELS; ++c) {
          const uint channel = is_rational && c == CHANNELS - 1 ? weight_channel : first_channel + uint(c);
          x[c] = Floats(points).at[point + channel * arguments.in_channel];
        }
      }
      stage[i] = x;
    }
    BARRIER;
    if (slot < slots) {
      int own[PATCHES];
      UNROLL for (int p = 0; p < PATCHES; ++p)
        own[p] = int(min(slot + uint(p) * slots, tile.num_patches - 1u) * count);
      ADDRESS weights = advanced(table.weights, (tile.weights + first * tile.stride) * 4u + unit_row * uint(ROWS), 4u);
      for (uint k = 0u; k < count; k += uint(COLUMNS)) {
        UNROLL for (int j = 0; j < COLUMNS; ++j) {
          vec4 x[PATCHES];
          UNROLL for (int p = 0; p < PATCHES; ++p) x[p] = stage[own[p] + j];
          UNROLL for (int q = 0; q < QUANTITIES; ++q) {
            const ADDRESS of_quantity = advanced(weights, uint(q) * columns, tile.stride * 16u);
            vec4 w = VEC4(0.0f, 0.0f, 0.0f, 0.0f);
            if (ROWS == 4) w = Vectors(of_quantity).at[0];
            if (ROWS == 1) w.x = Floats(of_quantity).at[0];
            UNROLL for (int p = 0; p < PATCHES; ++p) UNROLL for (int r = 0; r < ROWS; ++r)
              UNROLL for (int c = 0; c < CHANNELS; ++c)
                SUM(q, p, r, c) = fma(w[r], x[p][c], SUM(q, p, r, c));
          }
          weights = advanced(weights, tile.stride, 16u);
        }
        UNROLL for (int p = 0; p < PATCHES; ++p) own[p] += COLUMNS;
      }
    }
  }

  const uint num_made = tile.num_patches * tile.num_rows;
  const bool is_placed = !IS_NULL(table.patch_points);
  const bool is_run = !is_placed && tile.num_rows == tile.rows_of_patch;
  const uint run = tile.first_point;
#define has_point(p, r) \
  (slot < slots && slot + uint(p) * slots < tile.num_patches && unit_row + uint(r) * units < tile.num_rows)
#define place(p, r) ((slot + uint(p) * slots) * tile.num_rows + unit_row + uint(r) * units)
#define address_of(i)                                                                              \
  ((is_placed ? Numbers(table.patch_points).at[tile.first_patch + (i) / tile.num_rows]             \
              : run + (i) / tile.num_rows * tile.rows_of_patch) + tile.first_row + (i) % tile.num_rows)
#include "finish.inc"
}

#undef SUM
#undef has_point
#undef place
#undef address_of
