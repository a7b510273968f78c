// SPDX-License-Identifier: Apache-2.0
// `sublimit-mpi`: one mesh by many processes.
#include <fmt/core.h>

#include "../cli/support/command_line.h"
#include "../cli/support/input_files.h"
#include "../cli/support/standard_streams.h"
#include "commands.h"

int main(int argc, char** argv) {
  using namespace sublimit;
  cli::prepare_standard_streams();
  const Ranks ranks(argc, argv);
  CLI::App app("One mesh by many processes: mpirun -n N sublimit-mpi ...", "sublimit-mpi");
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.footer(
      "Example:\n"
      "  mpirun -n 2 sublimit-mpi bake torus.ply -s catmull-clark -l 2 -o shards\n"
      "  mpirun -n 3 sublimit-mpi apply shards pose.ply -o points.npy\n"
      "Results are the same for any number of processes, bit by bit, but for fits. Exit statuses are those of sublimit.");
  cli_mpi::Command chosen;
  for (const auto add : {cli_mpi::add_info, cli_mpi::add_bake, cli_mpi::add_apply, cli_mpi::add_verify,
                         cli_mpi::add_fit, cli_mpi::add_refine, cli_mpi::add_sample})
    add(app, chosen);
  int misuse = 0, verdict = 0;
  const int status = ranks.run([&] {
    std::string said;
    for (int i = 1; i < argc; ++i) said += (i > 1 ? " " : "") + std::string(argv[i]);
    check_alike(ranks, said, "options");  // first of all: who refuses its own would not be there for the others
    const cli::ParsedCommandLine line = cli::parse_command_line(app, argc, argv);
    if (ranks.is_first()) {
      fmt::print("{}", line.out);
      fmt::print(stderr, "{}", line.err);
    }
    misuse = line.status;
    if (!line.runs) return;
    ranks.together([&] { cli::check_input_files(*app.get_subcommands().front()); });
    verdict = chosen(ranks);
  });
  return cli::finish_standard_streams("sublimit-mpi", status != 0 ? status : misuse != 0 ? misuse : verdict);
}
