// SPDX-License-Identifier: Apache-2.0
#pragma once
// Shards as files: tables over the part's control points, which `load_table` reads, with two further arrays and
// the position in the set of shards:
//
//   shard.inputs   I64 #inputs       control points of the whole, ascending
//   shard.runs     I64 #runs x 2     runs of its points: first number in the whole table, number of points
//   metadata       shard.bake        hash of everything that determines the set, 16 hexadecimal digits
//                  shard.number (from 0), shard.count, shard.points (of the whole table), shard.control_points
//                  (of the whole mesh)
//
// A directory has "shard-0003-of-0008.safetensors", ..., and "shards.json", which is written after all shards.
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

/// Writes a shard.
/// @throws IoError, ResourceError  as `save_table`
void save_shard(const std::filesystem::path& path, const Shard& shard, const ShardPlace& place);
void save_manifest(const std::filesystem::path& directory, const ShardManifest& manifest);

struct LoadedShard {
  BakedTable<double> table;
  std::vector<std::int64_t> inputs;
  std::vector<PointRun> runs;
  ShardPlace place;
};
/// Loads a shard.
/// @throws FormatError, IoError, ResourceError  as `load_table`; a table that is not a shard, or whose arrays
///                                              do not fit
LoadedShard load_shard(const std::filesystem::path& path);
/// Loads a shard, and checks that it is the one of a manifest.
/// @throws FormatError  a shard of another bake
LoadedShard load_shard(const std::filesystem::path& directory, const ShardManifest& manifest, int number);
/// Returns the position of a shard in its set, without reading its data; absent if the file does not have the
/// name of a shard, or is damaged.
std::optional<ShardPlace> find_shard(const std::filesystem::path& path);

/// Loads the description of the shards of a directory.
/// @throws IoError      there is none: the bake is not finished
/// @throws FormatError  not a description of shards
ShardManifest load_manifest(const std::filesystem::path& directory);

}  // namespace sublimit
