// SPDX-License-Identifier: Apache-2.0
#pragma once
// Subcommands of `sublimit-mpi`: their options, and what all ranks then do.
#include <CLI/CLI.hpp>
#include <chrono>
#include <functional>

#include "sublimit/distributed/jobs/shard_jobs.h"

namespace sublimit::cli_mpi {

using Command = std::function<int(const Ranks&)>;  // the exit status, of all ranks the same
/// @param chosen  becomes the command if it is the one that is given
void add_info(CLI::App& app, Command& chosen);
void add_bake(CLI::App& app, Command& chosen);
void add_apply(CLI::App& app, Command& chosen);
void add_verify(CLI::App& app, Command& chosen);
void add_fit(CLI::App& app, Command& chosen);
void add_refine(CLI::App& app, Command& chosen);
void add_sample(CLI::App& app, Command& chosen);

/// What every subcommand has, and those with a mesh and a scheme.
struct Common {
  std::string mesh;
  MeshRequest request;
  std::vector<std::string> options;  ///< name=value
  int threads = 1;                   ///< of each rank
  std::string memory_limit;          ///< of all ranks of a machine
  bool quiet = false;
};
void add_run(CLI::App& command, Common& common);
void add_mesh(CLI::App& command, Common& common);

/// Levels or their limits, and how the mesh is divided for them.
struct Levels {
  BakeRequest request;
  Division division;
  bool limit = false;
  std::string partition = "scotch";
  /// With all that the options say.
  Levels resolved() const;
};
/// Adds --levels, --limit and --partition.
void add_levels(CLI::App& command, Levels& levels);

double seconds_since(std::chrono::steady_clock::time_point start);

/// What all commands begin with: threads, and who is told what is being done: stderr, of the first rank, if a person is
/// looking.
Told begin(const Ranks& ranks, const Common& common);
/// What is asked for, with all options: a misspelt name is told before a large file is read.
/// @throws InvalidOption  on all ranks
MeshRequest checked_request(const Ranks& ranks, const Common& common);
/// Reads the mesh; warnings go to stderr.
SpreadJob load(const Ranks& ranks, const Common& common, const Told& told);

}  // namespace sublimit::cli_mpi
