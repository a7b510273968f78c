// SPDX-License-Identifier: Apache-2.0
#pragma once
// What `sublimit` and `sublimit-mpi` have in common: options of a mesh and its scheme, threads, the words of messages.
#include <CLI/CLI.hpp>

#include <span>
#include <string>
#include <vector>

#include "sublimit/core/scheme_options.h"

namespace sublimit::cli {

/// Where a command keeps the options of a mesh and its scheme.
struct MeshOptions {
  std::string &mesh, &scheme, &boundary, &creasing, &triangles;
  std::string* face_varying;          ///< null: the command does not have it
  std::vector<std::string>& options;  ///< name=value
  bool &triangulate, &no_creases;
};
/// Adds the options to a subcommand.
/// @param kinds  kinds of files of MESH, for the help
void add_mesh_options(CLI::App& command, const MeshOptions& options, const std::string& kinds, bool scheme_required);

/// Returns words as a check of an option.
CLI::IsMember one_of(std::span<const char* const> words);

/// Returns options of a scheme, by name.
/// @param texts  name=value
/// @throws InvalidOption  another text, or a name twice
SchemeOptions scheme_options(const std::vector<std::string>& texts);

/// Limits the rest of the run to so many threads.
void limit_threads(int count);

/// Returns a message of the library in the words of the program: with the options that remedies need, and with
/// subcommands as they are typed ("`sublimit info`").
std::string in_words_of_the_program(std::string message);

}  // namespace sublimit::cli
