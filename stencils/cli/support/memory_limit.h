// SPDX-License-Identifier: Apache-2.0
#pragma once
// The option --mem-limit: how much memory a job may take, for jobs whose memory is predicted.
#include <CLI/CLI.hpp>

#include <string>

#include "sublimit/mesh/mesh.h"

namespace sublimit::cli {

/// Adds --mem-limit to a subcommand.
void add_memory_limit(CLI::App& command, std::string& limit);

/// Returns the value of --mem-limit in bytes; infinity if the text is empty. `2G` is 2 * 10^9 bytes, as this
/// program prints sizes; `2GiB` is 2 * 2^30.
/// @throws InvalidOption  not a size
double parse_memory_limit(const std::string& text);

/// Limits the predicted memory of the rest of the run to --mem-limit.
/// @throws InvalidOption  not a size
void limit_memory(const std::string& text);

/// Checks that the neighbourhoods of a mesh's faces fit into memory, before they are computed.
/// @throws ResourceError  they do not fit
void check_mesh_memory(const std::string& name, const Mesh& mesh);

}  // namespace sublimit::cli
