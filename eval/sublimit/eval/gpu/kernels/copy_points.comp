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
  const ADDRESS begin = advanced(arguments.results[0], FRAME, arguments.out_frame * size);
  const ADDRESS to = advanced(begin, pair.x, arguments.out_point * size);
  const ADDRESS from = advanced(begin, pair.y, arguments.out_point * size);
  for (uint c = 0u; c < arguments.channels; ++c) {
    const ADDRESS to_channel = advanced(to, c, arguments.out_channel * size);
    const ADDRESS from_channel = advanced(from, c, arguments.out_channel * size);
#ifdef HALF
    Halves(to_channel).at[0] = Halves(from_channel).at[0];
#else
    WrittenFloats(to_channel).at[0] = WrittenFloats(from_channel).at[0];
#endif
  }
}
