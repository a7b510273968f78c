// SPDX-License-Identifier: Apache-2.0
// Points that lie on several patches: their positions, made once, to where they are again.
#include "language.inc"

KERNEL(copy_points) {
  const uint i = WORKGROUP * uint(THREADS) + LANE;
  if (i >= arguments.count) return;
  const CopyTable table = CopyTables(arguments.table).at[0];
  const uvec2 pair = Entries(table.pairs).at[i];
#ifdef HALF
  const uint size = 2u;
#else
  const uint size = 4u;
#endif
  const ADDRESS out_ = advanced(arguments.results[0], FRAME, arguments.out_frame * size);
  const ADDRESS to = advanced(out_, pair.x, arguments.out_point * size), from = advanced(out_, pair.y, arguments.out_point * size);
  for (uint c = 0u; c < arguments.channels; ++c)
#ifdef HALF
    Halves(to).at[c * arguments.out_channel] = Halves(from).at[c * arguments.out_channel];
#else
    WrittenFloats(to).at[c * arguments.out_channel] = WrittenFloats(from).at[c * arguments.out_channel];
#endif
}
