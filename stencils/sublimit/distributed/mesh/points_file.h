// SPDX-License-Identifier: Apache-2.0
#pragma once
// Files of points, and of faces between them, that all ranks write: what they begin with, and where shards stand in
// them.
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sublimit/distributed/mesh/shared_file.h"
#include "sublimit/stencils/shards/shard.h"

namespace sublimit {

/// @throws InvalidOption  neither .npy nor .ply
void check_points_output(const std::filesystem::path& output);

/// What a binary .ply of points in double begins with.
/// @param num_faces  none: without faces; else each a byte that counts its corners, which have 32 bits each
std::string ply_header(std::int64_t num_points, std::optional<std::int64_t> num_faces = {});

/// Consecutive ones become one run.
/// @param items  of each face: the first one, how many
/// @param isolated   more of them, that stand before all
std::vector<PointRun> runs_of(std::span<const std::array<std::int64_t, 2>> items, std::int64_t isolated = 0);

/// Items, run after run, to where each run stands.
/// @param begin  of the first item of the whole in the file
/// @throws IoError, ResourceError  on this rank
void write_runs(SharedFile& file, std::int64_t begin, std::int64_t item_size, std::span<const PointRun> runs,
                std::span<const std::byte> items);

}  // namespace sublimit
