// SPDX-License-Identifier: Apache-2.0
// What the program does while it works: progress for a person who looks, nothing for a file, and an end on Ctrl-C. It
// is kept busy by a mesh that comes through a pipe.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "stencils/cli_program.h"
#include "sublimit/io/obj.h"
#include "support/meshes.h"

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
  void send(const ControlMesh& mesh) {
    const std::string text = format_obj(output(mesh));
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
  /// What came so far. Ends the terminal.
  std::string text() {
    ::close(std::exchange(theirs, -1));
    std::string all;
    char block[4096];
    for (ssize_t count; (count = ::read(ours, block, sizeof block)) > 0;) all.append(block, size_t(count));
    return all;
  }
};

TEST(CliProgress, ShowsOnATerminalAfterASecond) {
  const TemporaryDirectory directory;
  SlowMesh mesh(directory);
  Terminal terminal;
  Program program(
      {"refine", mesh.path.string(), "-s", "catmull-clark", "-l", "1", "-o", (directory / "out.obj").string()}, {},
      terminal.theirs);
  mesh.open();
  std::this_thread::sleep_for(1600ms);
  mesh.send(cube());
  EXPECT_EQ(program.wait().status, 0);
  const std::string text = terminal.text();
  expect_parts(text, {"reading ", "slow.obj ... 1 s"});
  EXPECT_TRUE(text.ends_with("\r\033[K")) << "the line stays";
}

TEST(CliProgress, IsForTerminalsOnlyAndNotIfQuiet) {
  const TemporaryDirectory directory;
  SlowMesh mesh(directory);
  const std::vector<std::string> arguments{
      "limit", mesh.path.string(), "-s", "catmull-clark", "-o", (directory / "out.ply").string()};
  std::vector<std::string> quiet = arguments;
  quiet.push_back("--quiet");
  {
    Program program(arguments);
    mesh.open();
    std::this_thread::sleep_for(1600ms);
    mesh.send(cube());
    expect_done(program.wait());
  }
  Terminal terminal;
  Program program(quiet, {}, terminal.theirs);
  mesh.open();
  std::this_thread::sleep_for(1600ms);
  mesh.send(cube());
  EXPECT_EQ(program.wait().out, "");
  EXPECT_EQ(terminal.text(), "");
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
  write_obj(directory / "mesh.obj", output(torus(48, 48)));
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
