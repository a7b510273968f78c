// SPDX-License-Identifier: Apache-2.0
// Points by sparse rows, one a thread: 32 rows lie side by side, so that neighbours read what lies together.
#include "language.inc"
#include "vectors.inc"

SHARED_OF_FILE(stage, THREADS + 2);

KERNEL(apply_rows) {
  SHARED_OF_KERNEL(stage, THREADS + 2);
  if (WORKGROUP * uint(THREADS) >= arguments.count) return;
  const RowTable table = RowTables(arguments.table).at[0];
  const ADDRESS points = advanced(arguments.points, FRAME, arguments.in_frame * 4u);
  const bool is_rational = arguments.channels >= 65536u;
  const uint first = WORKGROUP * uint(THREADS), num_made = min(uint(THREADS), arguments.count - first);

  float sums[QUANTITIES * CHANNELS];
#define SUM(q, p, r, c) sums[(q) * CHANNELS + (c)]
  UNROLL for (int i = 0; i < QUANTITIES * CHANNELS; ++i) sums[i] = 0.0f;
  if (LANE < num_made) {
    UNROLL for (int q = 0; q < QUANTITIES; ++q) {
      const uint row = uint(q) * table.quantity + first + LANE;
      const uint begin = Numbers(table.slices).at[row / 32u] + row % 32u, length = Numbers(table.lengths).at[row];
      for (uint k = 0u; k < length; ++k) {
        const uvec2 entry = Entries(table.entries).at[begin + 32u * k];
        const float w = AS_FLOAT(entry.y);
        const uint at = entry.x * arguments.in_point;
        UNROLL for (int c = 0; c < CHANNELS; ++c) {
          const uint channel =
              is_rational && c == CHANNELS - 1 ? arguments.channels >> 8 & 255u : (arguments.channels & 255u) + uint(c);
          SUM(q, 0, 0, c) = fma(w, Floats(points).at[at + channel * arguments.in_channel], SUM(q, 0, 0, c));
        }
      }
    }
  }

  const bool is_run = true;
  const uint run = table.first_point + first;
#define has_point(p, r) (LANE < num_made)
#define place(p, r) LANE
#define address_of(i) (run + (i))
#include "finish.inc"
}

#undef SUM
#undef has_point
#undef place
#undef address_of
