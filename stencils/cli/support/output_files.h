// SPDX-License-Identifier: Apache-2.0
#pragma once
// Files that a command line names twice.
#include <CLI/CLI.hpp>

namespace sublimit::cli {

/// Checks that no two files that a subcommand writes are the same, under whatever names: links and hard links too. The
/// file of -o may be one that is read, which is replaced at the end; other outputs may not, and nothing is written into
/// a file in place, such as standard output or a log, that is read.
/// @throws InvalidOption  names both
void check_output_files(const CLI::App& command);

}  // namespace sublimit::cli
