// SPDX-License-Identifier: Apache-2.0
// `-` in the place of a file: every subcommand that reads or writes one file reads standard input and writes standard
// output, the same bytes as files have.
#include <gtest/gtest.h>

#include <set>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "stencils/subcommands.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/detail/off.h"
#include "sublimit/io/detail/ply.h"
#include "support/gzip_bytes.h"

namespace sublimit::testing {
namespace {

using Words = std::vector<std::string>;

/// A pipe whose reader, or writer, is the program.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    ::fcntl(ends_[1], F_SETPIPE_SZ, 1 << 20);
  }
  /// A pipe that has a text, and its end.
  explicit Pipe(const std::string& text) : Pipe() {
    EXPECT_EQ(::write(ends_[1], text.data(), text.size()), ssize_t(text.size()));
    close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() { close(0), close(1); }

  int reader() const { return ends_[0]; }
  int writer() const { return ends_[1]; }
  void close(int end) {
    if (ends_[end] >= 0) ::close(std::exchange(ends_[end], -1));
  }

 private:
  int ends_[2] = {-1, -1};
};

/// Runs the program with a text in the pipe that is its standard input.
Outcome piped(const Words& words, const std::string& input) {
  const Pipe pipe(input);
  return sublimit(words, [&] { ::dup2(pipe.reader(), STDIN_FILENO); });
}

/// A subcommand with files IN and OUT.
struct Verb {
  Words words;
  std::string input, output;  ///< names of the files
  std::string format;         ///< empty: not needed
};

struct CliPipes : ::testing::Test {
  TemporaryDirectory directory;
  std::string path(const std::string& name) const { return (directory / name).string(); }
  Words with(Words words, const std::string& in, const std::string& out) const {
    for (std::string& word : words) {
      if (word == "IN") word = in;
      if (word == "OUT") word = out;
      if (word.starts_with("./")) word = path(word.substr(2));
    }
    return words;
  }

  CliPipes() {
    for (const char* const name : {"cube.obj", "stdin.obj"}) write_obj(path(name), cube());  // reports have the name
    write_off(path("cube.off"), cube());
    write_ply(path("cube.ply"), cube());
    directory.write("places.csv", "face,u,v\n0,0.5,0.25\n3,0,1\n");
    directory.write("points.csv", "x,y,z\n0.3,0.4,0.2\n");
    directory.write("rays.csv", "ox,oy,oz,dx,dy,dz\n0.1,0.2,-5,0,0,1\n");
    directory.write("polygon.csv", "x,y\n0,0\n1,2\n3,1\n4,0\n");
    directory.write("targets.csv", "vertex,x,y,z\n0,-1,-1,-1\n");
    directory.write("rates.csv", "v0,v1,rate\n0,1,3\n");
    directory.write(
        "cone.json",
        R"({"kind": "cone", "curve": {"degree": 1, "knots": [0, 0, 1, 1], "points": [[1, 0], [0, 1]]}, "apex": [0, 0, 2]})");
    directory.write("ball.json", R"({"kind": "implicit", "field": "sphere", "center": [0, 0, 0], "radius": 1})");
    expect_done(sublimit(
        {"bake", path("cube.obj"), "-s", "catmull-clark", "-l", "1", "-o", path("table.safetensors"), "--quiet"}));
    expect_done(sublimit({"tessellate", path("cube.obj"), "-s", "catmull-clark", "--chord", "5%", "-o",
                          path("triangles.ply"), "--quiet"}));
  }
};

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all{
      {{"refine", "IN", "-s", "catmull-clark", "-l", "1", "-o", "OUT"}, "cube.obj", "stdout.obj", "obj"},
      {{"refine", "IN", "-s", "catmull-clark", "-l", "1", "-o", "OUT"}, "cube.off", "stdout.ply", "ply"},
      {{"refine", "IN", "-s", "catmull-clark", "-l", "1", "-o", "OUT"}, "cube.ply", "stdout.stl", ".STL"},
      {{"refine", "IN", "-s", "chaikin", "-l", "2", "-o", "OUT"}, "polygon.csv", "stdout.csv", "csv"},
      {{"limit", "IN", "-s", "catmull-clark", "-l", "1", "-o", "OUT"}, "cube.obj", "stdout.off", "off"},
      {{"sample", "IN", "-s", "catmull-clark", "--grid", "3", "-o", "OUT"}, "cube.obj", "stdout.csv", ""},
      {{"sample", "./cube.obj", "-s", "catmull-clark", "--at", "IN", "-o", "OUT"}, "places.csv", "stdout.csv", ""},
      {{"sample", "IN", "--grid", "3", "-o", "OUT"}, "cone.json", "stdout.csv", ""},
      {{"sample", "IN", "-s", "chaikin", "--grid", "3", "-o", "OUT"}, "polygon.csv", "stdout.csv", ""},
      {{"closest", "IN", "-s", "catmull-clark", "--points", "./points.csv", "-o", "OUT"}, "cube.ply", "stdout.csv", ""},
      {{"closest", "./cube.obj", "-s", "catmull-clark", "--points", "IN", "-o", "OUT"}, "points.csv", "stdout.csv", ""},
      {{"intersect", "IN", "-s", "catmull-clark", "--rays", "./rays.csv", "-o", "OUT"}, "cube.obj", "stdout.csv", ""},
      {{"intersect", "./cube.obj", "-s", "catmull-clark", "--rays", "IN", "-o", "OUT"}, "rays.csv", "stdout.csv", ""},
      {{"tessellate", "IN", "-s", "catmull-clark", "--chord", "5%", "-o", "OUT"}, "cube.obj", "stdout.glb", "glb"},
      {{"tessellate", "./cube.obj", "-s", "catmull-clark", "--rates", "IN", "-o", "OUT"},
       "rates.csv",
       "stdout.ply",
       "ply"},
      {{"tessellate", "IN", "-s", "catmull-clark", "--chord", "5%", "-o", "./other.obj", "--places", "OUT"},
       "cube.obj",
       "stdout.csv",
       ""},
      {{"step", "IN", "-s", "catmull-clark", "-o", "OUT"}, "cube.obj", "stdout.step", "step"},
      {{"bake", "IN", "-s", "catmull-clark", "-l", "1", "-o", "OUT"}, "cube.obj", "stdout.safetensors", ""},
      {{"bake", "./cube.obj", "-s", "catmull-clark", "--at", "IN", "-o", "OUT"},
       "places.csv",
       "stdout.safetensors",
       ""},
      {{"bake", "./cube.obj", "-s", "catmull-clark", "--tessellation", "IN", "-o", "OUT"},
       "triangles.ply",
       "stdout.safetensors",
       ""},
      {{"construct", "IN", "-o", "OUT"}, "cone.json", "stdout.obj", ""},
      {{"implicit", "IN", "--cells", "4", "--tolerance", "1", "-o", "OUT"}, "ball.json", "stdout.obj", "obj"},
      {{"implicit", "./ball.json", "--at", "IN", "-o", "OUT"}, "points.csv", "stdout.csv", "csv"},
      {{"apply", "IN", "./cube.obj", "-o", "OUT"}, "table.safetensors", "stdout.obj", "obj"},
      {{"apply", "./table.safetensors", "IN", "-o", "OUT"}, "cube.ply", "stdout.npy", "npy"},
      {{"export", "IN", "-o", "OUT"}, "table.safetensors", "stdout.npz", "npz"},
      {{"export", "IN", "-o", "OUT"}, "table.safetensors", "stdout.mtx", "mtx"},
      {{"analyze", "IN", "-s", "catmull-clark", "--json", "OUT"}, "stdin.obj", "stdout.json", ""},
      {{"fit", "./cube.obj", "--targets", "IN", "-s", "catmull-clark", "-o", "OUT"},
       "targets.csv",
       "stdout.obj",
       "obj"},
      {{"fit", "IN", "--targets", "./targets.csv", "-s", "catmull-clark", "-o", "./other.obj", "--picture", "OUT"},
       "cube.obj",
       "stdout.svg",
       ""},
      {{"info", "IN", "-s", "catmull-clark", "--json"}, "cube.obj", "", ""},
      {{"verify", "IN"}, "table.safetensors", "", ""},
  };
  return all;
}

/// What names of files are in a text.
std::string without_names(std::string text, const Words& names) {
  for (const std::string& name : names)
    for (size_t at; (at = text.find(name)) != std::string::npos;) text.replace(at, name.size(), "FILE");
  return text;
}

TEST_F(CliPipes, EverySubcommandWritesTheSameBytes) {
  std::set<std::string> seen;
  for (const Verb& verb : verbs()) {
    SCOPED_TRACE(::testing::PrintToString(verb.words) + " " + verb.input);
    seen.insert(verb.words.front());
    const std::string in = path(verb.input), out = path(verb.output);
    const Outcome by_files = sublimit(with(verb.words, in, out));
    EXPECT_EQ(by_files.status, 0) << by_files.err;
    Words words = with(verb.words, "-", "-");
    if (!verb.format.empty()) words.insert(words.end(), {"--format", verb.format});
    const Outcome by_pipe = piped(words, read_file(in));
    EXPECT_EQ(by_pipe.status, 0) << by_pipe.err;
    if (verb.output.empty()) {
      const std::string device = "/dev/stdin" + std::filesystem::path(in).extension().string();
      EXPECT_EQ(without_names(by_pipe.out, {device}), without_names(by_files.out, {in}));
    } else {
      EXPECT_TRUE(by_pipe.out == read_file(out)) << by_pipe.out.substr(0, 400) << by_pipe.err;
      std::filesystem::remove(out);
    }
  }
  // These read and write no file.
  for (const char* const verb : {"schemes", "devices", "demo", "help"}) seen.insert(verb);
  std::set<std::string> all = subcommands();
  all.erase("flatten");
  EXPECT_EQ(seen, all);
}

TEST_F(CliPipes, FactsGoToStandardErrorIfAFileGoesToStandardOutput) {
  const Words words{"limit", path("cube.obj"), "-s", "catmull-clark", "-o", "-", "--format", "ply"};
  const Outcome outcome = sublimit(words);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(outcome.out.starts_with("ply\n"));
  expect_parts(outcome.err, {"/dev/stdout.ply: 8 limit points"});
  Words quiet = words;
  quiet.push_back("--quiet");
  EXPECT_EQ(sublimit(quiet).err, "");
}

TEST_F(CliPipes, NamesOfDevicesAreTheSameStreams) {
  const std::string mesh = read_file(path("cube.obj"));
  const Words tail{"-s", "catmull-clark", "-l", "1"};
  const auto run = [&](const std::string& in, const std::string& out, const Words& more = {}) {
    Words words{"refine", in, "-o", out};
    words.insert(words.end(), tail.begin(), tail.end());
    words.insert(words.end(), more.begin(), more.end());
    return expect_done(piped(words, mesh), true).out;
  };
  const std::string expected = run("-", "-", {"--format", "off"});
  EXPECT_TRUE(expected.starts_with("OFF"));
  EXPECT_EQ(run("/dev/stdin", "/dev/stdout", {"--format", "off"}), expected);
  EXPECT_EQ(run("/dev/fd/0", "/dev/fd/1", {"--format", "off"}), expected);
  EXPECT_EQ(run("/dev/stdin.obj", "/dev/stdout.off"), expected);
  EXPECT_EQ(run("-", "-", {"--format", "obj:off"}), expected);
  EXPECT_EQ(
      expect_done(piped({"refine", "-o", "-", "--format", "off", "-l", "1", "-s", "catmull-clark", "-"}, mesh)).out,
      expected)
      << "options before the argument";
}

/// A descriptor of a pipe, as shells make of <(command).
TEST_F(CliPipes, OtherDescriptorsAreFilesToo) {
  const Pipe pipe(read_file(path("cube.off")));
  const Outcome outcome = sublimit({"info", "/dev/fd/9", "-s", "catmull-clark"}, [&] { ::dup2(pipe.reader(), 9); });
  expect_parts(expect_done(outcome).out, {"/dev/fd/9.off"});
}

TEST_F(CliPipes, CompressedInputIsInflated) {
  for (const char* const name : {"cube.obj", "cube.ply", "cube.off"}) {
    const std::string whole = read_file(path(name));
    EXPECT_EQ(expect_done(piped({"info", "-", "-s", "catmull-clark"}, compressed(whole))).out,
              expect_done(piped({"info", "-", "-s", "catmull-clark"}, whole)).out);
  }
}

TEST_F(CliPipes, FilesAreReadFromWhereTheyAre) {
  const std::string text = read_file(path("cube.obj"));
  const std::string file = directory.write("with_a_line.txt", "read by somebody else\n" + text);
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  ::lseek(descriptor, off_t(std::string("read by somebody else\n").size()), SEEK_SET);
  const Outcome outcome = sublimit({"info", "-", "-s", "catmull-clark"}, [&] { ::dup2(descriptor, STDIN_FILENO); });
  ::close(descriptor);
  EXPECT_EQ(outcome.out, piped({"info", "-", "-s", "catmull-clark"}, text).out);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(CliPipes, WhatNoFirstByteTellsNeedsAFormat) {
  const Outcome without = piped({"info", "-"}, "8 6 0\n");
  expect_failure(without, 3, {"/dev/stdin: its first bytes do not tell its format", "--format"});
  expect_failure(piped({"info", "-", "--format", "off"}, "8 6 0\n"), 3, {"/dev/stdin.off"});
  expect_failure(piped({"info", "-", "--format", "obj"}, "call nothing.obj\n"), 3, {"/dev/stdin.obj", "no vertices"});
}

TEST_F(CliPipes, MistakesAreToldBeforeAnyWork) {
  const std::string mesh = read_file(path("cube.obj"));
  const Words refine{"refine", "-", "-s", "catmull-clark", "-l", "1", "-o"};
  const auto with_output = [&](Words more) {
    Words words = refine;
    words.insert(words.end(), more.begin(), more.end());
    return piped(words, mesh);
  };
  expect_failure(with_output({"-"}), 2, {"cannot write /dev/stdout without --format; obj, ply, off"});
  expect_failure(with_output({"-", "--format", "npz"}), 2, {"cannot write /dev/stdout as npz; obj, ply"});
  expect_failure(with_output({"-", "--format", "plz"}), 2, {"--format plz: there is no such format", "ply"});
  expect_failure(with_output({"-", "--format", "obj", "--matrix", "-"}), 2,
                 {"--output and --matrix are both standard output"});
  expect_failure(piped({"apply", "-", "-", "-o", path("out.obj")}, mesh), 2,
                 {"TABLE and POINTS are both standard input"});
  expect_failure(sublimit({"info", path("cube.obj"), "--format", "obj"}), 2, {"--format obj is for `-`"});
  expect_failure(piped({"info", "-", "--format", "obj:ply"}, mesh), 2, {"--format obj:ply", "one of them alone"});
  expect_failure(piped({"export", path("table.safetensors"), "-o", "-"}, ""), 2, {"without --format", "npz", "mtx"});
  expect_failure(piped({"analyze", "-s", "loop", "--export", "-"}, ""), 2, {"--export -: it should be a directory"});
  expect_failure(piped({"info", "-"}, ""), 3, {"/dev/stdin: empty; MESH is a control mesh"});
  expect_failure(sublimit({"info", "-"}), 3, {"/dev/stdin: empty"});  // /dev/null
  expect_failure(sublimit({"info", "-"}, [] { ::close(STDIN_FILENO); }), 3, {"standard input is closed"});
  expect_failure(sublimit({"info", "-"}, [] { ::dup2(::open("/tmp", O_RDONLY), STDIN_FILENO); }), 3,
                 {"/dev/stdin: cannot read: Is a directory"});
  Words closed = refine;
  closed.insert(closed.end(), {"-", "--format", "obj"});
  EXPECT_EQ(sublimit(closed, [] { ::close(STDOUT_FILENO); }).status, 3);
  expect_failure(piped({"refine", "-", "-s", "loop", "-l", "1", "-o", path("out.obj")}, "v 1 2\n"), 3,
                 {"/dev/stdin.obj:1: "});
  expect_failure(piped({"closest", path("cube.obj"), "-s", "catmull-clark", "--points", path("points.csv"), "-o",
                        path("out.csv"), "--sidecar", "-"},
                       mesh),
                 3, {"/dev/stdin.obj is an OBJ file; --sidecar is tags"});
  expect_failure(piped({"fit", "-", "--targets", path("targets.csv"), "-s", "catmull-clark", "-o", path("out.obj"),
                        "--mem-limit", "100"},
                       mesh),
                 4, {"/dev/stdin: more than", "the limit is 100.0 bytes"});
  EXPECT_FALSE(std::filesystem::exists(directory / "out.obj"));
}

TEST_F(CliPipes, ReadersThatLeaveAreAQuietEnd) {
  write_obj(path("torus.obj"), torus(64, 64));
  Pipe output;
  Program program({"refine", path("torus.obj"), "-s", "catmull-clark", "-l", "3", "-o", "-", "--format", "obj",
                   "--matrix", path("matrix.mtx")},
                  [&] { ::dup2(output.writer(), STDOUT_FILENO); });
  output.close(1);
  char byte = 0;
  EXPECT_EQ(::read(output.reader(), &byte, 1), 1);
  output.close(0);  // much more is to come
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(std::filesystem::exists(directory / "matrix.mtx"));
}

TEST_F(CliPipes, FullDisksAreErrors) {
  expect_failure(sublimit({"refine", path("cube.obj"), "-s", "catmull-clark", "-l", "1", "-o", "-", "--format", "obj"},
                          [] { ::dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO); }),
                 4, {"/dev/stdout.obj: cannot write: No space left on device"});
}

/// Text before and behind stays: standard output is no file of ours.
TEST_F(CliPipes, StandardOutputIsWrittenInPlace) {
  const std::string file = directory.write("log.txt", "before\n");
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  const auto to_file = [&] { ::dup2(descriptor, STDOUT_FILENO); };
  const Words words{"refine", path("cube.obj"), "-s", "catmull-clark", "-l", "0", "-o", "-", "--format", "off"};
  const std::string expected = sublimit(words).out;
  expect_done(sublimit(words, to_file));
  expect_done(sublimit(words, to_file));
  ::close(descriptor);
  EXPECT_EQ(read_file(file), "before\n" + expected + expected);
}

/// Names in a file are relative to where the program runs.
TEST_F(CliPipes, ManifestsAreRelativeToTheWorkingDirectory) {
  const auto there = [&](const std::string& text) {
    const Pipe pipe(text);
    return sublimit({"bake", "--manifest", "-"}, [&] {
      ::dup2(pipe.reader(), STDIN_FILENO);
      if (::chdir(directory.path().c_str()) != 0) ::_exit(126);
    });
  };
  expect_parts(
      expect_done(
          there(R"({"mesh": "cube.obj", "scheme": "loop", "triangulate": true, "levels": 1, "output": "t.safetensors"})"
                "\n"))
          .out,
      {"t.safetensors: done", "1 jobs"});
  EXPECT_TRUE(std::filesystem::exists(directory / "t.safetensors"));
  expect_parts(expect_done(there("")).out, {"0 jobs"});
}

}  // namespace
}  // namespace sublimit::testing
