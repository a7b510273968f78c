// SPDX-License-Identifier: Apache-2.0
#pragma once
// Shards as files: ordinary tables over the part's points, which `load_table` reads, with arrays more and a place in
// the set:
//
//   shard.inputs   I64 #inputs       control points of the whole, ascending
//   shard.runs     I64 #runs x 2     its points, run by run: the first one in the whole, how many
//   metadata       shard.bake        a name for all that decides what is in the set, 16 hexadecimal digits
//                  shard.number (from 0), shard.count, shard.points (of all), shard.control_points (of the whole)
//
// A directory has "shard-0003-of-0008.safetensors", .. and, written when all are there, "shards.json".
#include <filesystem>
#include <string>

#include "sublimit/stencils/shards/shard.h"

namespace sublimit {

/// Position of a shard in the whole table.
struct ShardPlace {
  std::string bake;
  int number = 0, count = 1;            ///< from 0
  std::int64_t num_points = 0;          ///< points of the whole table
  std::int64_t num_control_points = 0;  ///< control points of the whole table
};

/// Description of all shards, written after them.
struct ShardManifest {
  ShardPlace all;             ///< without a number
  std::string scheme, faces;  ///< name; a sum over the faces of the mesh, 16 hexadecimal digits
  int level = 0;
  bool limit = false;
};
inline constexpr const char* shard_manifest_name = "shards.json";
std::string shard_name(int number, int count);

/// @throws IoError, ResourceError  as `save_table`
void save_shard(const std::filesystem::path& path, const Shard& shard, const ShardPlace& place);
void save_manifest(const std::filesystem::path& directory, const ShardManifest& manifest);

struct LoadedShard {
  BakedTable<double> table;
  std::vector<std::int64_t> inputs;
  std::vector<PointRun> runs;
  ShardPlace place;
};
/// @throws FormatError, IoError, ResourceError  as `load_table`; a table that is no shard, or whose arrays do not fit
LoadedShard load_shard(const std::filesystem::path& path);
/// Loads a shard, and checks that it is the one of a manifest.
/// @throws FormatError  a shard of another bake
LoadedShard load_shard(const std::filesystem::path& directory, const ShardManifest& manifest, int number);
/// The place alone, if there is a whole shard, of a shard's name; its data is not read.
std::optional<ShardPlace> find_shard(const std::filesystem::path& path);

/// @throws IoError  none there: a bake that is not done;  FormatError
ShardManifest load_manifest(const std::filesystem::path& directory);

}  // namespace sublimit
