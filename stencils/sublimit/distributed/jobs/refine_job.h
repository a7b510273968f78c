// SPDX-License-Identifier: Apache-2.0
#pragma once
// Writing a level of a mesh, or its limit, to one file. Parts are baked, applied and written one after the
// other, and none is kept, which bounds memory.
#include "sublimit/distributed/jobs/shard_jobs.h"

namespace sublimit {

struct RefinedFile {
  std::int64_t points = 0, faces = 0;  ///< faces: 0 unless the file is a .ply
  int parts = 0;
};
/// Writes a level or its limit. Points have the order of `apply_shards`. Faces of a .ply, quadrilaterals or
/// triangles, have the order of their control faces; those of holes are left out. Collective: all ranks call.
/// @param division  `parts` 0: so many that a rank handles about 8 million points (500 MB) at a time
/// @param output    .npy or .ply
/// @throws InvalidOption  on all ranks: another kind of output, a .ply of more points than 32-bit numbers count
/// @throws                otherwise as `bake_shards`
RefinedFile write_refined(const Ranks& ranks, const SpreadJob& job, const BakeRequest& request, Division division,
                          const std::filesystem::path& output, const Told& told);

}  // namespace sublimit
