// SPDX-License-Identifier: Apache-2.0
// info: counts of a mesh, and how its parts would be.
#include <fmt/core.h>

#include "../cli/support/mesh_facts.h"
#include "commands.h"
#include "sublimit/distributed/jobs/info_job.h"

namespace sublimit::cli_mpi {
namespace {

struct InfoOptions {
  Common common;
  bool as_json = false;
};

void print(const SpreadInfo& info, const std::string& name) {
  cli::print_counts(info, name, "sublimit-mpi");
  fmt::print("  no manifold at     {} vertices, {} edges; {} vertices are in no face\n", info.nonmanifold_vertices,
             info.nonmanifold_edges, info.isolated_vertices);
  cli::print_verdict(info);
  fmt::print("  {} part{}, one a rank{}\n", info.parts, info.parts == 1 ? "" : "s",
             info.parts == 1 ? "" : ", from the least to the most:");
  fmt::print("    faces            {} to {}\n", info.part_faces.least, info.part_faces.most);
  fmt::print("    faces around     {} to {}, {} ring(s)\n", info.halo_faces.least, info.halo_faces.most, info.rings);
  fmt::print("    memory           about {:.1f} to {:.1f} MB a rank, before tables and points\n",
             double(info.part_bytes.least) / 1e6, double(info.part_bytes.most) / 1e6);
  cli::print_warnings(info);
}

/// @return  exit status 1 where the scheme does not take the mesh
int info(const Ranks& ranks, const InfoOptions& options) {
  const Told told = begin(ranks, options.common);
  const std::string& name = options.common.mesh;
  const MeshRequest request = checked_request(ranks, options.common);
  told("reading " + name);
  const SpreadInfo found = spread_info(ranks, request, read_spread_mesh(ranks, name), name, told);
  const int status = found.why_not.empty() ? 0 : 1;
  if (!ranks.is_first()) return status;
  if (options.as_json)
    fmt::print("{}\n", to_json(found, name).dump(2));
  else
    print(found, name);
  return status;
}

}  // namespace

void add_info(CLI::App& app, Command& chosen) {
  auto* command =
      app.add_subcommand("info", "Counts, valences, boundaries and tags of a mesh, and what its parts take");
  auto options = std::make_shared<InfoOptions>();
  add_mesh(*command, options->common);
  command->get_option("--scheme")->required(false);
  command->add_flag("--json", options->as_json, "As JSON");
  command->footer(
      "Examples:\n"
      "  mpirun -n 2 sublimit-mpi info city.ply\n"
      "  mpirun -n 8 sublimit-mpi info city.ply -s loop --json\n"
      "Counts are those of `sublimit info`, which names every fault of a mesh too. Exit status 1 where the scheme does\n"
      "not take the mesh.");
  command->callback([&chosen, options] { chosen = [options](const Ranks& ranks) { return info(ranks, *options); }; });
}

}  // namespace sublimit::cli_mpi
