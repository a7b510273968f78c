// SPDX-License-Identifier: Apache-2.0
#pragma once
// Parsing the command line of a program with subcommands: adds `help [SUBCOMMAND]`, and messages that suggest
// the nearest names for unknown ones.
#include <CLI/CLI.hpp>

#include <string>

namespace sublimit::cli {

/// Result of parsing a command line.
struct ParsedCommandLine {
  bool runs = true;                                     ///< true: run the subcommand; false: only print the texts
  int status = 0;                                       ///< exit status if `runs` is false: 0, or 2 for an error
  std::string out, err;                                 ///< texts for stdout and stderr
  std::string manual_kind = {}, manual_directory = {};  ///< arguments of `--generate KIND DIR`
};

/// Adds the subcommand `help`, and parses a command line. `--generate KIND DIR` is accepted if the program has
/// that option.
ParsedCommandLine parse_command_line(CLI::App& app, int argc, const char* const* argv);

}  // namespace sublimit::cli
