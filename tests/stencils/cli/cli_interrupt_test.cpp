// SPDX-License-Identifier: Apache-2.0
// What the program does while it works: progress for a person who looks, nothing for a file, and an end on Ctrl-C. It
// is kept busy by a mesh that comes through a pipe.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

using namespace std::chrono_literals;

/// A mesh file that the program reads for as long as we like.
class SlowMesh {
 public:
  explicit SlowMesh(const TemporaryDirectory& directory) : path(directory / "slow.obj") {
    if (::mkfifo(path.c_str(), 0600) != 0) throw std::runtime_error("no pipe");
  }
  ~SlowMesh() { close(); }
  /// Waits for the program to open it.
  void open() { file_ = ::open(path.c_str(), O_WRONLY); }
  void send(const Mesh& mesh) {
    const std::string text = format_obj(mesh);
    EXPECT_EQ(::write(file_, text.data(), text.size()), ssize_t(text.size()));
    close();
  }
  const std::filesystem::path path;

 private:
  void close() {
    if (file_ >= 0) ::close(std::exchange(file_, -1));
  }
  int file_ = -1;
};

struct Terminal {
  int ours = ::posix_openpt(O_RDWR | O_NOCTTY), theirs = -1;
  Terminal() {
    if (ours < 0 || ::grantpt(ours) != 0 || ::unlockpt(ours) != 0) throw std::runtime_error("no terminal");
    theirs = ::open(::ptsname(ours), O_RDWR | O_NOCTTY);
  }
  ~Terminal() {
    if (theirs >= 0) ::close(theirs);
    ::close(ours);
  }
  /// Waits until this came.
  void wait_for(const std::string& part) {
    pollfd something{ours, POLLIN, 0};
    while (all_.find(part) == std::string::npos && ::poll(&something, 1, 60'000) == 1) read_some();
  }
  /// All that came. Ends the terminal.
  std::string text() {
    ::close(std::exchange(theirs, -1));
    while (read_some()) continue;
    return all_;
  }

 private:
  bool read_some() {
    char block[4096];
    const ssize_t count = ::read(ours, block, sizeof block);
    if (count > 0) all_.append(block, size_t(count));
    return count > 0;
  }
  std::string all_;
};

// The program that shows its progress begins last, so that the others had as long for theirs.
TEST(CliProgress, ShowsOnATerminalAfterASecondAndNowhereElse) {
  const TemporaryDirectory directory, of_file, of_quiet;
  SlowMesh mesh(directory), mesh_of_file(of_file), mesh_of_quiet(of_quiet);
  const auto arguments = [](const TemporaryDirectory& place, const SlowMesh& from) {
    return std::vector<std::string>{"limit", from.path.string(),          "-s", "catmull-clark",
                                    "-o",    (place / "out.ply").string()};
  };
  std::vector<std::string> quietly = arguments(of_quiet, mesh_of_quiet);
  quietly.push_back("--quiet");
  Terminal terminal, terminal_of_quiet;
  Program to_file(arguments(of_file, mesh_of_file));
  mesh_of_file.open();
  Program quiet(quietly, {}, terminal_of_quiet.theirs);
  mesh_of_quiet.open();
  Program shown(arguments(directory, mesh), {}, terminal.theirs);
  mesh.open();
  terminal.wait_for("slow.obj ... 1 s");
  for (SlowMesh* each : {&mesh, &mesh_of_file, &mesh_of_quiet}) each->send(cube());
  EXPECT_EQ(shown.wait().status, 0);
  const std::string text = terminal.text();
  expect_parts(text, {"reading ", "slow.obj ... 1 s"});
  EXPECT_TRUE(text.ends_with("\r\033[K")) << "the line stays";
  expect_done(to_file.wait());
  EXPECT_EQ(quiet.wait().out, "");
  EXPECT_EQ(terminal_of_quiet.text(), "");
}

TEST(CliInterrupt, EndsAReader) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryDirectory directory;
    SlowMesh mesh(directory);
    Program program({"info", mesh.path.string()});
    mesh.open();
    ::kill(program.id(), signal);
    EXPECT_EQ(program.wait().status, 130);
    EXPECT_EQ(directory.num_files(), 1);
  }
}

TEST(CliInterrupt, LeavesNoPartialOutput) {
  const TemporaryDirectory directory;
  write_obj(directory / "mesh.obj", torus(48, 48));
  const auto begun = [&] {
    for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
      if (entry.path().extension() == ".tmp") return true;
    return false;
  };
  bool in_time = false;
  for (int attempt = 0; attempt < 5 && !in_time; ++attempt) {  // the file may be complete before we act
    Program program({"refine", (directory / "mesh.obj").string(), "-s", "catmull-clark", "-l", "4", "-o",
                     (directory / "out.obj").string()});
    for (int i = 0; i < 60000 && !begun() && !std::filesystem::exists(directory / "out.obj"); ++i)
      std::this_thread::sleep_for(1ms);
    ::kill(program.id(), SIGINT);
    const int status = program.wait().status;
    EXPECT_TRUE(status == 130 || status == 0) << status;
    in_time = status == 130 && !std::filesystem::exists(directory / "out.obj");
    std::filesystem::remove(directory / "out.obj");
    EXPECT_EQ(directory.num_files(), 1);
  }
  EXPECT_TRUE(in_time);
}

TEST(CliInterrupt, IsIgnoredWhereTheParentAsksForIt) {
  const TemporaryDirectory directory;
  SlowMesh mesh(directory);
  Program program({"info", mesh.path.string(), "--quiet"}, [] { std::signal(SIGINT, SIG_IGN); });
  mesh.open();
  ::kill(program.id(), SIGINT);
  mesh.send(cube());
  expect_done(program.wait());
}

}  // namespace
}  // namespace sublimit::testing
