// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables of a mesh in shards: made, looked over, applied, by any numbers of ranks.
#include <filesystem>
#include <functional>

#include "sublimit/distributed/jobs/spread_job.h"
#include "sublimit/distributed/shards/spread_table.h"

namespace sublimit {

/// Told what is being done, on the first rank.
using Told = std::function<void(const std::string&)>;

/// A shard of a mesh's part and the points that it has in the whole.
struct SpreadShards {
  BakeMethod method = BakeMethod::patterns;
  int rings = 0, parts = 0;
  std::int64_t num_points = 0;                      ///< of the whole
  std::vector<int> part;                            ///< of each face of the own run
  std::vector<std::vector<std::int64_t>> owned;     ///< faces of each part of this rank
  std::vector<std::array<std::int64_t, 2>> points;  ///< of each face of the own run: the first one, how many
  int first_part = 0;                               ///< of this rank
};
/// @param rings  more than are needed, or 0
/// @param part   of each face of the own run, if that is known already
/// @throws as `shard_method`, on all ranks
SpreadShards divide(const Ranks& ranks, const SpreadJob& job, Patterns& patterns, const BakeRequest& request,
                    const Division& division, int rings = 0, std::optional<std::vector<int>> part = {});
/// All ranks call, each for its part of that number, or for none that it needs.
/// @param faces  gets the faces between its points (shard_faces.h), if given: then `shards` have a ring more than
///               `shard_rings`
Shard made_shard(const Ranks& ranks, const SpreadJob& job, Patterns& patterns, const BakeRequest& request,
                 const SpreadShards& shards, int number, bool needed, FaceList* faces = nullptr);

struct ShardsMade {
  ShardManifest manifest;
  int made = 0, kept = 0, rings = 0;
};
/// Shards that a directory has already, of the same bake, stay.
/// @param overwrite  those of another bake go; else that is an error
/// @throws InvalidOption, IoError, ResourceError, ...  on all ranks
ShardsMade bake_shards(const Ranks& ranks, const SpreadJob& job, const BakeRequest& request, const Division& division,
                       const std::filesystem::path& directory, bool overwrite, int rings, const Told& told);

/// Points of the poses in a file, into an .npy or .ply.
/// @return  frames
std::int64_t apply_shards(const Ranks& ranks, const std::filesystem::path& directory,
                          const std::filesystem::path& points, const std::filesystem::path& output, bool any_cage,
                          const Told& told);

/// What keeps a directory from being a whole table, in words; empty: nothing. Every shard is read.
std::vector<std::string> verify_shards(const Ranks& ranks, const std::filesystem::path& directory, const Told& told);

}  // namespace sublimit
