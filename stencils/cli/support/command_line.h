// SPDX-License-Identifier: Apache-2.0
#pragma once
// Command lines of a program with subcommands: `help [SUBCOMMAND]`, and messages that say what is wrong in a line and
// offer the nearest names.
#include <CLI/CLI.hpp>

#include <string>

namespace sublimit::cli {

/// Result of parsing a command line.
struct ParsedCommandLine {
  bool runs = true;      ///< a subcommand is to run; otherwise only the texts are to print
  int status = 0;        ///< else the exit status: 0, or 2 for a line that is wrong
  std::string out, err;  ///< texts for stdout and stderr
  std::string manual_kind = {}, manual_directory = {};  ///< arguments of `--generate KIND DIR`
};

/// Adds the subcommand `help` and parses. `--generate KIND DIR` is taken if the program has that option.
ParsedCommandLine parse_command_line(CLI::App& app, int argc, const char* const* argv);

}  // namespace sublimit::cli
