// SPDX-License-Identifier: Apache-2.0
// Bad input and bad command lines: the exit status, a message that says what, where and what would be right, and no
// output.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cstring>

#include <linux/capability.h>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit::testing {
namespace {

using namespace std::string_literals;
using Parts = std::initializer_list<std::string_view>;

const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";  // lines 1 to 4
const std::string quad = vertices + "f 1 2 3 4\n";                    // line 5

/// Refines and takes limits of a file of this name and text; both must fail alike, and write nothing.
void expect_rejected(const std::string& name, const std::string& text, Parts parts,
                     const std::string& scheme = "catmull-clark") {
  const TemporaryDirectory directory;
  const std::string mesh = directory.write(name, text).string();
  for (const char* command : {"refine", "limit"}) {
    SCOPED_TRACE(command + " "s + name + ":\n" + text.substr(0, 200));
    const Outcome outcome = sublimit({command, mesh, "-s", scheme, "-l", "1", "-o", (directory / "out.obj").string()});
    expect_failure(outcome, 3, parts);
    EXPECT_TRUE(outcome.err.starts_with("sublimit: ")) << outcome.err;
    EXPECT_EQ(count_of(outcome.err, "\n"), 1u) << outcome.err;
    EXPECT_EQ(directory.num_files(), 1);
  }
}

/// Refines a good mesh with other arguments added; these must fail, and write nothing.
void expect_refused_by_all(const std::vector<std::string>& arguments, int status, Parts parts) {
  const TemporaryDirectory directory;
  std::vector<std::string> all{"refine", directory.write("mesh.obj", quad).string(), "-o",
                               (directory / "out.obj").string()};
  std::string trace;
  for (const std::string& argument : arguments) {
    all.push_back(argument);
    trace += " " + argument;
  }
  SCOPED_TRACE(trace);
  expect_failure(sublimit(all), status, parts);
  EXPECT_EQ(directory.num_files(), 1);
}

/// Refines a good mesh into this file, which must fail.
void expect_unwritable(const TemporaryDirectory& directory, const std::string& output, Parts parts,
                       const std::function<void()>& prepare = {}) {
  SCOPED_TRACE(output);
  const std::string mesh = directory.write("mesh.obj", quad).string();
  const long files = directory.num_files();
  expect_failure(sublimit({"refine", mesh, "-s", "catmull-clark", "-l", "1", "-o", output}, prepare), 3, parts);
  EXPECT_EQ(directory.num_files(), files);
}

TEST(CliInput, MissingFileOrDirectory) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "out.obj").string();
  expect_failure(sublimit({"refine", (directory / "none.obj").string(), "-s", "loop", "-l", "1", "-o", out}), 3,
                 {"none.obj", "cannot read", "No such file"});
  std::filesystem::create_directory(directory / "folder.obj");
  expect_failure(sublimit({"refine", (directory / "folder.obj").string(), "-s", "loop", "-l", "1", "-o", out}), 3,
                 {"folder.obj", "directory", "name a file in it"});
  expect_failure(sublimit({"info", (directory / "none.obj").string()}), 3, {"none.obj", "No such file"});
  expect_failure(sublimit({"info", (directory / (std::string(400, 'x') + ".obj")).string()}), 3, {"cannot read"});
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(CliInput, NoMesh) {
  expect_rejected("empty.obj", "", {"empty.obj", "empty"});
  expect_rejected("empty.ply", "", {"empty.ply"});
  expect_rejected("points.obj", vertices, {"points.obj", "no faces", "'f a b c"});
  expect_rejected("none.ply",
                  "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                  "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
                  {"none.ply", "no elements 'face'"});
  expect_rejected("none.off", "OFF\n1 0 0\n0 0 0\n", {"none.off", "no faces"});
  expect_rejected("mesh.dae", quad, {"mesh.dae", "'.dae'", all_formats().readers_in_words({contents::meshes}, "and")});
  expect_rejected("mesh.dae.gz", quad, {"mesh.dae.gz", "'.dae.gz'"});
}

TEST(CliInput, BinaryGarbage) {
  std::string bytes =
      "\x7f"
      "ELF\x02\x01\x01"s +
      std::string(64, '\0');
  for (int i = 0; i < 2000; ++i) bytes += char(i * 97 % 251);
  for (const std::string& extension : all_formats().readers({contents::meshes}))
    expect_rejected("garbage" + extension, bytes, {"garbage" + extension});
}

TEST(CliInput, Indices) {
  expect_rejected("zero.obj", vertices + "f 0 1 2\n", {"zero.obj:5", "index 0", "count from 1"});
  expect_rejected("far.obj", vertices + "f 1 2 9\n", {"far.obj:5", "index 9", "4 vertices"});
  expect_rejected("back.obj", vertices + "f -1 -2 -9\n", {"back.obj:5", "index -9", "4 vertices"});
  expect_rejected("word.obj", vertices + "f 1 2 x\n", {"word.obj:5", "'x'"});
  expect_rejected("two.obj", vertices + "f 1 2\n", {"two.obj:5", "2 corners", "at least 3"});
}

TEST(CliInput, Numbers) {
  const std::string rest = "v 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (const char* number : {"nan", "inf", "-inf", "1e999", "abc", "0x1", "1,5"})
    expect_rejected("number.obj", "v 0 0 "s + number + "\n" + rest, {"number.obj:1", number});
  expect_rejected("short.obj", "v 0 0\n" + rest, {"short.obj:1", "coordinate z"});
}

TEST(CliInput, Tags) {
  expect_rejected("tag.obj", quad + "t crease 2/1/0 0 99 2\n", {"tag.obj:6", "crease", "99", "0 to 3"});
  expect_rejected("tag.obj", quad + "t crease 2/1/0 0 1 -2\n", {"tag.obj:6", "-2", "0 or more"});
  expect_rejected("tag.obj", quad + "t crease 2/1/0 0 1 nan\n", {"tag.obj:6", "nan"});
  expect_rejected("tag.obj", quad + "t crease 2/1 0 1 2\n", {"tag.obj:6", "crease", "2/1/0"});
  expect_rejected("tag.obj", quad + "t crease 2/1/0 0\n", {"tag.obj:6", "fewer arguments"});
  expect_rejected("tag.obj", quad + "t corner 1/1/0 7 2\n", {"tag.obj:6", "corner", "7", "0 to 3"});
  expect_rejected("tag.obj", quad + "t hole 1/0/0 1\n", {"tag.obj:6", "hole", "face 1"});
  expect_rejected("tag.obj", quad + "t interpolateboundary 1/0/0 7\n", {"tag.obj:6", "7", "0 to 2"});
  expect_rejected("tag.obj", quad + "t creasemethod 0/0/1 soft\n", {"tag.obj:6", "'soft'", "'chaikin'"});
}

TEST(CliInput, Sidecar) {
  for (const auto& [json, what] :
       {std::pair{R"({"holeIndices")", "mesh.json"}, {R"({"holeIndices": [4]})", "holeIndices"}}) {
    const TemporaryDirectory directory;
    const std::string mesh = directory.write("mesh.obj", quad).string();
    directory.write("mesh.json", json);
    expect_failure(sublimit({"limit", mesh, "-s", "catmull-clark", "-o", (directory / "out.ply").string()}), 3,
                   {"mesh.json", what});
    EXPECT_EQ(directory.num_files(), 2);
  }
}

TEST(CliInput, QuadGivenToLoop) {
  for (const char* scheme : {"loop", "loop-warren"})
    expect_rejected("quad.obj", quad, {"quad.obj", "face 0", "4 corners", "triangles", scheme}, scheme);
  const TemporaryDirectory directory;  // level 0 is not refined, but has no limit either
  expect_failure(sublimit({"limit", directory.write("quad.obj", quad).string(), "-s", "loop", "-o",
                           (directory / "out.ply").string()}),
                 3, {"quad.obj", "face 0", "4 corners", "loop"});
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(CliCommandLine, UnknownWords) {
  expect_refused_by_all({"-s", "catmul-clark", "-l", "1"}, 2, {"catmul-clark", "catmull-clark", "sublimit schemes"});
  expect_refused_by_all({"-s", "lop", "-l", "1"}, 2, {"'lop'", "loop"});
  expect_refused_by_all({"-s", "loop", "-l", "1", "--smooth"}, 2, {"--smooth"});
  expect_refused_by_all({"-l", "1"}, 2, {"--scheme", "required"});
  expect_refused_by_all({"-s", "loop"}, 2, {"--levels", "required"});
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{}, {"polish"}, {"refine"}, {"info"}})
    EXPECT_EQ(sublimit(arguments).status, 2);
}

TEST(CliCommandLine, Values) {
  expect_refused_by_all({"-s", "catmull-clark", "-l", "-1"}, 2, {"-1", "0 or more"});
  expect_refused_by_all({"-s", "catmull-clark", "-l", "two"}, 2, {"two"});
  expect_refused_by_all({"-s", "catmull-clark", "-l", "1.5"}, 2, {"1.5"});
  expect_refused_by_all({"-s", "catmull-clark", "-l", "99999999999"}, 2, {"99999999999"});
  expect_refused_by_all({"-s", "catmull-clark", "-l", "1", "--boundary", "sharp"}, 2, {"sharp", "edge-and-corner"});
  expect_refused_by_all({"-s", "catmull-clark", "-l", "1", "--creasing", "fast"}, 2, {"fast", "chaikin"});
  expect_refused_by_all({"-s", "catmull-clark", "-l", "1", "--triangles", "round"}, 2, {"round", "smooth"});
  expect_refused_by_all({"-s", "catmull-clark", "-l", "1", "--threads", "0"}, 2, {"threads"});
  expect_refused_by_all({"-s", "catmull-clark", "-l", "1", "--option", "triangles=round"}, 2,
                        {"triangles", "round", "smooth"});
  expect_refused_by_all({"-s", "catmull-clark", "-l", "1", "--option", "triangles"}, 2, {"triangles", "name=value"});
  expect_refused_by_all({"-s", "catmull-clark", "-l", "1", "--option", "tension=1"}, 2, {"tension", "catmull-clark"});
  expect_refused_by_all({"-s", "bilinear", "-l", "1", "--triangles", "smooth"}, 2, {"triangles", "bilinear"});
}

TEST(CliResources, AbsurdLevelsSayWhatMemoryTheyTake) {
  expect_refused_by_all({"-s", "catmull-clark", "-l", "40"}, 4, {"40 levels", "of memory", "use at most"});
  expect_refused_by_all({"-s", "catmull-clark", "-l", "100000"}, 4, {"100000 levels", "of memory"});
  const TemporaryDirectory directory;
  const std::string mesh = directory.write("mesh.obj", quad).string();
  expect_failure(sublimit({"limit", mesh, "-s", "catmull-clark", "-l", "40", "-o", (directory / "out.ply").string()}),
                 4, {"40 levels", "GB of memory", "use at most 1"});
}

/// No file may grow beyond some KB, as on a full disk.
void fill_disk() {
  const rlimit limit{4096, 4096};
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

TEST(CliResources, FullDiskLeavesNothing) {
  for (const char* command : {"refine", "limit"})
    for (const char* name : {"out.obj", "out.ply"}) {
      const TemporaryDirectory directory;
      write_obj(directory / "mesh.obj", torus(16, 16));
      expect_failure(sublimit({command, (directory / "mesh.obj").string(), "-s", "catmull-clark", "-l", "1", "-o",
                               (directory / name).string()},
                              fill_disk),
                     4, {name, "cannot write", "free some space"});
      EXPECT_EQ(directory.num_files(), 1);
    }
  const TemporaryDirectory directory;
  write_obj(directory / "mesh.obj", torus(16, 16));
  directory.write("out.obj", "what was there");
  expect_failure(sublimit({"refine", (directory / "mesh.obj").string(), "-s", "catmull-clark", "-l", "1", "-o",
                           (directory / "out.obj").string(), "--matrix", (directory / "out.mtx").string()},
                          fill_disk),
                 4, {"out.mtx", "cannot write"});
  EXPECT_EQ(directory.num_files(), 2);
  EXPECT_EQ(read_file(directory / "out.obj"), "what was there");
  expect_failure(sublimit({"demo", (directory / "demo").string()}, fill_disk), 4, {"cannot write"});
}

TEST(CliResources, TooLittleMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizers need the address space that this takes away";
#endif
  const TemporaryDirectory directory;
  write_obj(directory / "mesh.obj", torus(64, 64));
  const auto starve = [] {
    const rlimit limit{rlim_t{200} << 20, rlim_t{200} << 20};
    ::setrlimit(RLIMIT_AS, &limit);
  };
  expect_failure(sublimit({"refine", (directory / "mesh.obj").string(), "-s", "catmull-clark", "-l", "5", "--threads",
                           "1", "-o", (directory / "out.obj").string()},
                          starve),
                 4, {"memory"});
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(CliOutput, PipeThatItsReaderClosesIsAnError) {
  const TemporaryDirectory directory;
  write_obj(directory / "mesh.obj", torus(64, 64));
  for (const char* const name : {"pipe.obj", "pipe.ply"}) {
    const std::string pipe = (directory / name).string();
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(reader, 0);
    Program program({"refine", (directory / "mesh.obj").string(), "-s", "catmull-clark", "-l", "2", "-o", pipe});
    pollfd something{reader, POLLIN, 0};
    EXPECT_EQ(::poll(&something, 1, 60'000), 1);
    ::close(reader);  // the rest of the mesh is more than a pipe holds
    expect_failure(program.wait(), 3, {name, "cannot write: Broken pipe"});
  }
  EXPECT_EQ(directory.num_files(), 3);
}

TEST(CliOutput, NamesAreCheckedBeforeWorkStarts) {
  const TemporaryDirectory directory;
  const std::string missing = (directory / "missing.obj").string();  // what is wrong with the output is told first
  std::string writers;
  for (const std::string& extension : all_formats().writers({contents::meshes}))
    writers += (writers.empty() ? "" : " or ") + extension;
  for (const char* command : {"refine", "limit"}) {
    expect_failure(sublimit({command, missing, "-s", "loop", "-l", "1", "-o", (directory / "out.dae").string()}), 2,
                   {"out.dae", writers});
    expect_failure(sublimit({command, missing, "-s", "loop", "-l", "1", "-o", (directory / "out.obj.gz").string()}), 2,
                   {"out.obj.gz", writers + "; compressed files are read, not written"});
    expect_failure(sublimit({command, missing, "-s", "loop", "-l", "1", "-o", (directory / "a" / "out.obj").string()}),
                   3, {"out.obj", "is not a directory"});
  }
  expect_failure(sublimit({"refine", missing, "-s", "loop", "-l", "1", "-o", (directory / "out.obj").string(),
                           "--matrix", (directory / "out.npz").string()}),
                 2, {"out.npz", ".mtx"});
  EXPECT_EQ(directory.num_files(), 0);
}

TEST(CliOutput, UnwritablePlaces) {
  const TemporaryDirectory directory;
  directory.write("file", "");
  std::filesystem::create_directory(directory / "folder.obj");
  expect_unwritable(directory, (directory / "file" / "out.obj").string(), {"out.obj", "is not a directory"});
  expect_unwritable(directory, (directory / "folder.obj").string(), {"folder.obj", "directory", "name a file"});
  expect_unwritable(directory, "/proc/out.obj", {"/proc/out.obj", "cannot write"});
  expect_failure(sublimit({"demo", (directory / "file").string()}), 3, {"file", "directory"});
  expect_failure(sublimit({"demo", (directory / "file" / "demo").string()}), 3, {"demo", "directory"});
}

TEST(CliOutput, ReadOnlyDirectory) {
  const TemporaryDirectory directory;
  const std::filesystem::path closed = directory / "closed";
  std::filesystem::create_directory(closed);
  std::ofstream(closed / "mine.obj") << "what was there";
  ::chmod((closed / "mine.obj").c_str(), 0444);
  ::chmod(closed.c_str(), 0555);
  const auto obey = [] { ::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE); };  // permissions hold for root, too
  expect_unwritable(directory, (closed / "out.obj").string(), {"out.obj", "not writable"}, obey);
  ::chmod(closed.c_str(), 0755);
  expect_unwritable(directory, (closed / "mine.obj").string(), {"mine.obj", "not writable"}, obey);
  EXPECT_EQ(read_file(closed / "mine.obj"), "what was there");
}

}  // namespace
}  // namespace sublimit::testing
