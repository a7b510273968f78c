// SPDX-License-Identifier: Apache-2.0
#pragma once
// Subcommands of `sublimit-mpi`: their options, and the functions that all ranks run.
#include <CLI/CLI.hpp>
#include <chrono>
#include <functional>

#include "sublimit/distributed/jobs/shard_jobs.h"

namespace sublimit::cli_mpi {

using Command = std::function<int(const Ranks&)>;  // returns the exit status, the same on all ranks
// Each adds a subcommand to the program; if the command line has it, `chosen` is set to the function to run.
void add_info(CLI::App& app, Command& chosen);
void add_bake(CLI::App& app, Command& chosen);
void add_apply(CLI::App& app, Command& chosen);
void add_verify(CLI::App& app, Command& chosen);
void add_fit(CLI::App& app, Command& chosen);
void add_refine(CLI::App& app, Command& chosen);
void add_sample(CLI::App& app, Command& chosen);

/// Options of all subcommands (`add_run`), and of those with a mesh and a scheme (`add_mesh`).
struct Common {
  std::string mesh;
  MeshRequest request;
  std::vector<std::string> options;  ///< name=value
  int threads = 1;                   ///< threads of each rank
  std::string memory_limit;          ///< text of --mem-limit
  bool quiet = false;
};
void add_run(CLI::App& command, Common& common);
void add_mesh(CLI::App& command, Common& common);

/// Options for levels or their limits, and for the division of the mesh.
struct Levels {
  BakeRequest request;
  Division division;
  bool limit = false;
  std::string partition = "scotch";
  /// Returns the options with `limit` and `partition` transferred to `request` and `division`.
  Levels resolved() const;
};
/// Adds --levels, --limit and --partition.
void add_levels(CLI::App& command, Levels& levels);

double seconds_since(std::chrono::steady_clock::time_point start);

/// Starts a command: sets the limits of memory and threads. Returns the function for progress, which writes to
/// stderr on the first rank if that is a terminal and --quiet is not given. Collective: all ranks call.
Told begin(const Ranks& ranks, const Common& common);
/// Returns the request with all options, after checking them: a misspelt name is reported before a large file
/// is read.
/// @throws InvalidOption  on all ranks
MeshRequest checked_request(const Ranks& ranks, const Common& common);
/// Reads the mesh, and writes its warnings to stderr. Collective: all ranks call.
SpreadJob load(const Ranks& ranks, const Common& common, const Told& told);

}  // namespace sublimit::cli_mpi
