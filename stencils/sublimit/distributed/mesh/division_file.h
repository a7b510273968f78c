// SPDX-License-Identifier: Apache-2.0
#pragma once
// The part of each face, kept in a file beside the shards: PT-Scotch may divide a mesh in another way each
// time, but a bake that is continued needs the division of its first run. "division.safetensors" is a
// safetensors file with one tensor:
//
//   part      I32 #faces
//   metadata  division   hash of the mesh, the request and the number of parts, 16 hexadecimal digits
#include <filesystem>
#include <optional>

#include "sublimit/distributed/mesh/spread_mesh.h"

namespace sublimit {

inline constexpr const char* division_name = "division.safetensors";

/// Returns the parts of this rank's run of faces; absent on all ranks if any of them finds no valid file with
/// this name. Collective: all ranks call.
/// @param name  expected text of `division`
std::optional<std::vector<int>> load_division(const Ranks& ranks, const std::filesystem::path& directory,
                                              const std::string& name, const Runs& faces, int parts);
/// Writes the file. Collective: all ranks call.
/// @param part  part of each face of this rank's run
/// @throws IoError, ResourceError  on all ranks
void save_division(const Ranks& ranks, const std::filesystem::path& directory, const std::string& name,
                   const Runs& faces, const std::vector<int>& part);

}  // namespace sublimit
