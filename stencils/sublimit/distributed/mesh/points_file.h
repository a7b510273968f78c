// SPDX-License-Identifier: Apache-2.0
#pragma once
// Files of points, and of faces between them, that all ranks write: their headers, and the positions of shards
// in them.
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sublimit/distributed/mesh/shared_file.h"
#include "sublimit/stencils/shards/shard.h"

namespace sublimit {

/// Checks the extension of an output.
/// @throws InvalidOption  an extension other than .npy and .ply
void check_points_output(const std::filesystem::path& output);

/// Returns the header of a binary .ply of points in double.
/// @param num_faces  number of faces, each stored as a byte with its number of corners, then 32 bits for each
///                   corner; absent: the file has no faces
std::string ply_header(std::int64_t num_points, std::optional<std::int64_t> num_faces = {});

/// Returns the runs of the items of some faces; consecutive items are joined into one run.
/// @param items     for each face: number of its first item in the whole, and number of items
/// @param isolated  number of further items, which are the first ones of the whole
std::vector<PointRun> runs_of(std::span<const std::array<std::int64_t, 2>> items, std::int64_t isolated = 0);

/// Writes items to their positions in a file.
/// @param begin  offset of the first item of the whole in the file, in bytes
/// @param items  items of all runs, one run after the other
/// @throws IoError, ResourceError  on this rank
void write_runs(SharedFile& file, std::int64_t begin, std::int64_t item_size, std::span<const PointRun> runs,
                std::span<const std::byte> items);

}  // namespace sublimit
