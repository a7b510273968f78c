// SPDX-License-Identifier: Apache-2.0
#pragma once
// --mem-limit: how much memory a job may take, where that is predicted.
#include <CLI/CLI.hpp>

#include <string>

#include "sublimit/mesh/mesh.h"

namespace sublimit::cli {

/// Adds --mem-limit to a subcommand.
void add_memory_limit(CLI::App& command, std::string& limit);

/// Bytes that --mem-limit says, or as many as there are. `2G`: two thousand million bytes, as this program writes
/// sizes; `2GiB`: 2 * 2^30.
/// @throws InvalidOption  no size
double parse_memory_limit(const std::string& text);

/// Holds the rest of the run to --mem-limit.
/// @throws InvalidOption  no size
void limit_memory(const std::string& text);

/// Fails before a mesh's neighbourhoods are looked at if they alone take more than there is.
/// @throws ResourceError
void check_mesh_memory(const std::string& name, const Mesh& mesh);

}  // namespace sublimit::cli
