// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which part has which face, kept beside the shards: PT-Scotch may divide a mesh in another way each time, and a bake
// that goes on must not. A safetensors file, "division.safetensors", with one tensor:
//
//   part      I32 #faces
//   metadata  division   what was divided, into how many, 16 hexadecimal digits
#include <filesystem>
#include <optional>

#include "sublimit/distributed/mesh/spread_mesh.h"

namespace sublimit {

inline constexpr const char* division_name = "division.safetensors";

/// Parts of the own run of faces, if they are there, and of this name, on all ranks.
std::optional<std::vector<int>> load_division(const Ranks& ranks, const std::filesystem::path& directory,
                                              const std::string& name, const Runs& faces, int parts);
/// All ranks call.
/// @throws IoError, ResourceError  on all ranks
void save_division(const Ranks& ranks, const std::filesystem::path& directory, const std::string& name,
                   const Runs& faces, const std::vector<int>& part);

}  // namespace sublimit
