// SPDX-License-Identifier: Apache-2.0
// Standard streams that somebody closes, or that are full: what nobody reads is dropped, files and the exit status are
// those of the work, and text that is lost otherwise is an error.
#include <fcntl.h>
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

using Words = std::vector<std::string>;

/// Runs in the child: this descriptor becomes a pipe that nobody reads.
void lose_reader(int descriptor) {
  int ends[2];
  if (::pipe(ends) != 0) ::_exit(126);
  ::close(ends[0]);
  ::dup2(ends[1], descriptor);
  ::close(ends[1]);
}

void fill(int descriptor) { ::dup2(::open("/dev/full", O_WRONLY), descriptor); }

struct Files {
  TemporaryDirectory directory;
  std::string mesh = (directory / "mesh.obj").string(), out = (directory / "out.obj").string();
  Files() { write_obj(mesh, cube()); }
};

TEST(CliStreams, ClosedPipeIsAQuietEnd) {
  const Files on;
  for (const Words& words : {Words{"schemes"},
                             {"schemes", "--json"},
                             {"info", on.mesh},
                             {"devices"},
                             {"--help"},
                             {"refine", "--help"},
                             {"--version"}}) {
    SCOPED_TRACE(words.front());
    expect_done(sublimit(words, [] { lose_reader(STDOUT_FILENO); }));
    EXPECT_EQ(sublimit(words,
                       [] {
                         lose_reader(STDOUT_FILENO);
                         lose_reader(STDERR_FILENO);
                       })
                  .status,
              0);
  }
}

TEST(CliStreams, ErrorsKeepTheirStatusWithoutAReader) {
  const Files on;
  const auto alone = [] {
    lose_reader(STDOUT_FILENO);
    lose_reader(STDERR_FILENO);
  };
  EXPECT_EQ(sublimit({"info", (on.directory / "none.obj").string()}, alone).status, 3);
  EXPECT_EQ(sublimit({"info", on.mesh, "-s", "lop"}, alone).status, 2);
  EXPECT_EQ(sublimit({"refnie"}, alone).status, 2);
  const std::string broken = on.directory.write("broken.safetensors", std::string("\x08\0\0\0\0\0\0\0{}      ", 16));
  EXPECT_EQ(sublimit({"verify", broken}, alone).status, 1) << "the verdict is no, whoever reads why";
}

TEST(CliStreams, FilesAreWrittenAllTheSame) {
  const Files on;
  const Words words{"limit", on.mesh, "-s", "catmull-clark", "-l", "1", "-o", on.out};
  expect_done(sublimit(words));
  const std::string expected = read_file(on.out);
  const std::vector<std::function<void()>> ways{[] { lose_reader(STDOUT_FILENO); }, [] { ::close(STDOUT_FILENO); },
                                                [] { ::close(STDERR_FILENO); }, [] { ::close(STDIN_FILENO); },
                                                [] {
                                                  for (int i = 0; i < 3; ++i) ::close(i);
                                                }};
  for (const std::function<void()>& way : ways) {
    std::filesystem::remove(on.out);
    EXPECT_EQ(sublimit(words, way).status, 0);
    EXPECT_EQ(read_file(on.out), expected) << "a file that gets the number of a closed stream has its text";
  }
  EXPECT_EQ(on.directory.num_files(), 2);
}

TEST(CliStreams, TextThatIsLostIsAnError) {
  const Files on;
  for (const Words& words : {Words{"schemes"}, {"info", on.mesh, "--json"}, {"--help"}, {"refine", "--help"}})
    expect_failure(sublimit(words, [] { fill(STDOUT_FILENO); }), 4,
                   {"sublimit: standard output: cannot write: No space left on device"});
  // Nothing is left to say it on.
  EXPECT_EQ(sublimit({"info", on.mesh}, [] { fill(STDERR_FILENO); }).status, 0);
  EXPECT_EQ(sublimit({"info", on.mesh, "-s", "lop"}, [] { fill(STDERR_FILENO); }).status, 2);
}

/// A descriptor that gives up instead of waiting, as programs that share a terminal or a pipe may make it.
TEST(CliStreams, SlowReadersGetEverything) {
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  ASSERT_GE(::fcntl(ends[1], F_SETPIPE_SZ, 4096), 4096);
  Program program({"schemes", "--json"}, [&] {
    ::fcntl(ends[1], F_SETFL, O_NONBLOCK);
    ::dup2(ends[1], STDOUT_FILENO);
  });
  ::close(ends[1]);
  std::string text;
  char block[512];
  for (ssize_t count; (count = ::read(ends[0], block, sizeof block)) > 0;) text.append(block, size_t(count));
  ::close(ends[0]);
  expect_done(program.wait());
  EXPECT_EQ(text, expect_done(sublimit({"schemes", "--json"})).out);
}

}  // namespace
}  // namespace sublimit::testing
