// SPDX-License-Identifier: Apache-2.0
// The program `sublimit`: parses the command line, runs one subcommand, turns errors into exit statuses.
#include <fmt/core.h>

#include <csignal>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "support/command_line.h"
#include "support/common.h"
#include "support/ending.h"
#include "support/heap.h"
#include "support/input_files.h"
#include "support/manual.h"
#include "support/output_files.h"
#include "support/standard_streams.h"
#include "support/stream_arguments.h"
#include "sublimit/base/error.h"
#include "sublimit/base/version.h"

namespace {

using namespace sublimit;

int run(int argc, char** argv) {
  CLI::App app("Subdivision surfaces as sparse matrices, and their exact limits.", "sublimit");
  app.formatter(std::make_shared<cli::HelpFormatter>());
  app.set_version_flag("--version", "sublimit " SUBLIMIT_VERSION);
  std::string generate;  // what it is given is in the parsed line
  app.add_option("--generate", generate, "Write the manual into a directory; KIND is man, bash, zsh, fish or markdown");
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  sublimit demo\n"
      "  sublimit refine cage.obj -s catmull-clark -l 2 -o refined.obj\n"
      "  sublimit limit cage.obj -s catmull-clark -l 3 --normals -o surface.ply\n"
      "  sublimit sample cage.obj -s catmull-clark --random 1000 --derivatives 2 -o points.csv\n"
      "  sublimit fit cage.obj --targets points.csv -s catmull-clark -o fitted.obj\n"
      "  sublimit bake cage.obj -s catmull-clark -l 3 -o level3.safetensors\n"
      "  sublimit apply level3.safetensors animation.npy -o refined.npy\n"
      "  sublimit refine - -s loop -l 2 -o - --format ply < cage.obj > refined.ply      standard input and output");
  std::vector<std::pair<std::string, cli::Command>> commands{{"schemes", cli::add_schemes(app)},
                                                             {"info", cli::add_info(app)},
                                                             {"refine", cli::add_refine(app)},
                                                             {"limit", cli::add_limit(app)},
                                                             {"sample", cli::add_sample(app)},
                                                             {"closest", cli::add_closest(app)},
                                                             {"intersect", cli::add_intersect(app)},
                                                             {"tessellate", cli::add_tessellate(app)},
                                                             {"flatten", cli::add_flatten(app)},
                                                             {"step", cli::add_step(app)},
                                                             {"bake", cli::add_bake(app)},
                                                             {"construct", cli::add_construct(app)},
                                                             {"implicit", cli::add_implicit(app)},
                                                             {"apply", cli::add_apply(app)},
                                                             {"devices", cli::add_devices(app)},
                                                             {"verify", cli::add_verify(app)},
                                                             {"export", cli::add_export(app)},
                                                             {"analyze", cli::add_analyze(app)},
                                                             {"fit", cli::add_fit(app)},
                                                             {"demo", cli::add_demo(app)}};
  for (CLI::App* command : app.get_subcommands({})) cli::add_stream_format(*command);
  const cli::ParsedCommandLine line = cli::parse_command_line(app, argc, argv);
  fmt::print("{}", line.out);
  fmt::print(stderr, "{}", line.err);
  if (!line.manual_kind.empty()) {
    cli::write_manual(cli::program_page(app), line.manual_kind, line.manual_directory);
    return 0;
  }
  for (const auto& [name, command] : commands)
    if (line.runs && app.got_subcommand(name)) {
      cli::open_stream_arguments(*app.get_subcommand(name));
      cli::check_output_files(*app.get_subcommand(name));
      cli::check_input_files(*app.get_subcommand(name));
      try {
        return command();
      } catch (const Error& error) {
        throw Error(error.code(), cli::in_words_of_the_program(error.what()));
      }
    }
  return line.status;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a full disk is an error with a message, not the end
  cli::prepare_standard_streams();
  cli::prepare_heap();
  cli::handle_lack_of_memory();
  cli::end(cli::guarded([&] {
    cli::handle_interrupts();
    return run(argc, argv);
  }));
}
