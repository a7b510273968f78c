// SPDX-License-Identifier: Apache-2.0
// The program `sublimit`: parses the command line, runs one subcommand, turns errors into exit statuses.
#include <fmt/core.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <new>
#include <thread>

#include "command_line.h"
#include "common.h"
#include "heap.h"
#include "input_files.h"
#include "standard_streams.h"
#include "sublimit/base/error.h"

namespace {

using namespace sublimit;

constexpr int fault_of_ours = 70;

std::atomic<bool> interrupted = false;

/// Removes temporaries of unfinished outputs; whether there were any.
bool remove_temporaries() {
  const std::string mark = "." + std::to_string(::getpid()) + "-";
  std::error_code ignored;
  bool found = false;
  for (const std::string& directory : cli::output_directories())
    for (const auto& entry : std::filesystem::directory_iterator(directory, ignored)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(".") && name.ends_with(".tmp") && name.find(mark) != std::string::npos)
        found |= std::filesystem::remove(entry.path(), ignored);
    }
  return found;
}

/// Ctrl-C ends the program with status 130 and takes the temporaries of unfinished outputs along.
void handle_interrupts() {
  sigset_t interrupts;
  sigemptyset(&interrupts);
  for (const int number : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    ::sigaction(number, nullptr, &action);
    if (action.sa_handler != SIG_IGN) sigaddset(&interrupts, number);  // nohup and `&` ask us not to care
  }
  pthread_sigmask(SIG_BLOCK, &interrupts, nullptr);
  std::thread([interrupts] {
    int signal = 0;
    while (sigwait(&interrupts, &signal) != 0) ::pause();  // only if there are none to wait for
    interrupted = true;
    while (remove_temporaries()) continue;  // the other threads may have begun another one
    _exit(130);
  }).detach();
}

int guarded(const cli::Command& command) {
  try {
    return command();
  } catch (const Error& error) {
    if (interrupted) return 130;  // its temporary was taken away
    const int status = exit_status(error.code());
    fmt::print(stderr, "sublimit: {}{}\n", status == fault_of_ours ? "a fault of ours: " : "", error.what());
    return status;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "sublimit: out of memory; use fewer levels or samples\n");
    return exit_status(ErrorCode::resource_error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "sublimit: a fault of ours: {}\n", error.what());
  } catch (...) {
    fmt::print(stderr, "sublimit: a fault of ours\n");
  }
  return fault_of_ours;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a full disk is an error with a message, not the end
  cli::prepare_standard_streams();
  cli::prepare_heap();
  handle_interrupts();

  CLI::App app("Subdivision surfaces as sparse matrices, and their exact limits.", "sublimit");
  app.set_version_flag("--version", "sublimit " SUBLIMIT_VERSION);
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
      "Exit status: 0 done; 1 the verdict is no (verify); 2 bad command line; 3 bad input or unwritable output; 4 too little\n"
      "memory or disk; 70 a fault of ours; 130 interrupted.");
  std::vector<std::pair<std::string, cli::Command>> commands{{"schemes", cli::add_schemes(app)},
                                                             {"info", cli::add_info(app)},
                                                             {"refine", cli::add_refine(app)},
                                                             {"limit", cli::add_limit(app)},
                                                             {"sample", cli::add_sample(app)},
                                                             {"closest", cli::add_closest(app)},
                                                             {"intersect", cli::add_intersect(app)},
                                                             {"tessellate", cli::add_tessellate(app)},
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
  const cli::ParsedCommandLine line = cli::parse_command_line(app, argc, argv);
  fmt::print("{}", line.out);
  fmt::print(stderr, "{}", line.err);
  int status = line.status;
  for (const auto& [name, command] : commands)
    if (line.runs && app.got_subcommand(name))
      status = guarded([&app, name = name, run = command] {
        cli::check_input_files(*app.get_subcommand(name));
        return run();
      });
  status = cli::finish_standard_streams("sublimit", status);
  _exit(interrupted ? 130 : status);  // the thread that waits for interrupts has nothing to finish
}
