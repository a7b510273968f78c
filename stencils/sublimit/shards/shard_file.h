// SPDX-License-Identifier: Apache-2.0
#pragma once
// Shards as files: ordinary tables over the part's points, which `load_table` reads, with two arrays more and a place
// in the set:
//
//   shard.inputs     I64 #inputs        control points of the whole, ascending
//   shard.patches    I32 #patches x 3   face of the part's level that has the patterns, its turn, its share
//   metadata         shard.number (from 0), shard.count, shard.first_point, shard.points (of all),
//                    shard.control_points (of the whole)
//
// A directory has "shard-0003-of-0008.safetensors", .. and, written when all are there, "shards.json".
#include <filesystem>

#include "sublimit/shards/shard.h"

namespace sublimit {

/// What a shard is of.
struct ShardPlace {
  int number = 0, count = 1;     ///< from 0
  std::int64_t first_point = 0;  ///< of the whole: its own follow
  std::int64_t num_points = 0;   ///< of the whole
  std::int64_t num_control_points = 0;
};

std::string shard_name(int number, int count);

/// @throws IoError, ResourceError  as `save_table`
void save_shard(const std::filesystem::path& path, const Shard& shard, const ShardPlace& place);

struct LoadedShard {
  BakedTable<double> table;
  std::vector<std::int64_t> inputs;
  ShardPlace place;
};
/// @throws FormatError, IoError, ResourceError  as `load_table`; a table that is no shard, or whose arrays do not fit
LoadedShard load_shard(const std::filesystem::path& path);

}  // namespace sublimit
