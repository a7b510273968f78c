// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables of a mesh in shards: baking, verifying and applying them. The number of ranks may differ between these
// steps.
#include <filesystem>
#include <functional>

#include "sublimit/distributed/jobs/spread_job.h"
#include "sublimit/distributed/shards/spread_table.h"

namespace sublimit {

/// Function for progress, called by all ranks with a description of each step: "dividing". The first rank shows
/// it.
using Told = std::function<void(const std::string&)>;

/// Division of a mesh into shards, and the numbers of each face's points in the whole table.
struct SpreadShards {
  BakeMethod method = BakeMethod::patterns;
  int rings = 0, parts = 0;
  std::int64_t num_points = 0;                      ///< points of the whole table
  std::vector<int> part;                            ///< part of each face of this rank's run
  std::vector<std::vector<std::int64_t>> owned;     ///< faces of each part of this rank
  std::vector<std::array<std::int64_t, 2>> points;  ///< for each face of this rank's run: first point, number of points
  int first_part = 0;                               ///< first part of this rank
};
/// Divides a mesh into shards. Collective: all ranks call.
/// @param rings  least number of rings around parts; 0: as many as are needed
/// @param part   part of each face of this rank's run, if it is known already
/// @throws as `shard_method`, on all ranks
SpreadShards divide(const Ranks& ranks, const SpreadJob& job, Patterns& patterns, const BakeRequest& request,
                    const Division& division, int rings = 0, std::optional<std::vector<int>> part = {});
/// Bakes one shard of this rank. Collective: all ranks call, also those that need none.
/// @param number  which of this rank's parts, from 0
/// @param needed  false: the result is empty, as it is if this rank has no part of that number
/// @param faces   if given, set to the faces between the shard's points (shard_faces.h); `shards.rings` must be
///                at least one more than `shard_rings`
Shard made_shard(const Ranks& ranks, const SpreadJob& job, Patterns& patterns, const BakeRequest& request,
                 const SpreadShards& shards, int number, bool needed, FaceList* faces = nullptr);

struct ShardsMade {
  ShardManifest manifest;
  int made = 0, kept = 0, rings = 0;
};
/// Bakes all shards of a mesh into a directory. Shards of the same bake that are there already are kept.
/// Collective: all ranks call.
/// @param overwrite  remove shards of another bake; otherwise they are an error
/// @param rings      least number of rings around parts; 0: as many as are needed
/// @throws InvalidOption, IoError, ResourceError, ...  on all ranks
ShardsMade bake_shards(const Ranks& ranks, const SpreadJob& job, const BakeRequest& request, const Division& division,
                       const std::filesystem::path& directory, bool overwrite, int rings, const Told& told);

/// Applies the shards of a directory to the poses in a file. Collective: all ranks call.
/// @param points    file with the poses: a mesh or an .npy (spread_frames.h)
/// @param output    .npy or .ply
/// @param any_cage  accept points of a mesh with other faces than those that were baked
/// @return  number of frames
std::int64_t apply_shards(const Ranks& ranks, const std::filesystem::path& directory,
                          const std::filesystem::path& points, const std::filesystem::path& output, bool any_cage,
                          const Told& told);

/// Returns the faults that keep a directory from being a whole table; empty if it is one. Every shard is read.
/// Collective: all ranks call; only the first rank gets the faults.
std::vector<std::string> verify_shards(const Ranks& ranks, const std::filesystem::path& directory, const Told& told);

}  // namespace sublimit
