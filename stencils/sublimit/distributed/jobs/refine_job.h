// SPDX-License-Identifier: Apache-2.0
#pragma once
// A level of a mesh, or its limit, into one file: part after part is baked, applied and written, and none is kept.
#include "sublimit/distributed/jobs/shard_jobs.h"

namespace sublimit {

struct RefinedFile {
  std::int64_t points = 0, faces = 0;  ///< faces: of a .ply
  int parts = 0;
};
/// Points stand as `apply_shards` has them. Faces of a .ply, quadrilaterals or triangles, are in the order of the
/// control faces that they are of; those of holes are left out.
/// @param division  `parts` 0: as many as keep each of a size that does not matter
/// @param output    .npy or .ply
/// @throws InvalidOption  on all ranks: another kind of output, a .ply of points that 32 bits do not count;  else as
///                        `bake_shards`
RefinedFile write_refined(const Ranks& ranks, const SpreadJob& job, const BakeRequest& request, Division division,
                          const std::filesystem::path& output, const Told& told);

}  // namespace sublimit
