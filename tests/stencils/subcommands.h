// SPDX-License-Identifier: Apache-2.0
#pragma once
// Subcommands of the program, read from its help.
#include <regex>
#include <set>
#include <string>

#include "stencils/cli_program.h"

namespace sublimit::testing {

/// Returns the names under "Subcommands:" of `sublimit --help`.
inline std::set<std::string> subcommands() {
  const std::string help = expect_done(sublimit({"--help"})).out;
  static const std::regex line(R"(\n  ([a-z]+)  )");
  std::set<std::string> names;
  const std::string list = help.substr(std::min(help.find("Subcommands:"), help.size()));
  for (std::sregex_iterator at(list.begin(), list.end(), line), end; at != end; ++at) names.insert((*at)[1]);
  return names;
}

}  // namespace sublimit::testing
