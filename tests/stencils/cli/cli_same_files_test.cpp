// SPDX-License-Identifier: Apache-2.0
// Files that a command line names twice: -o may be the input, which is replaced when all is done; two outputs, or an
// input that another output would overwrite, are refused, under whatever names.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/detail/ply.h"

namespace sublimit::testing {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct CliSameFiles : ::testing::Test {
  TemporaryDirectory directory;
  std::string path(const std::string& name) const { return (directory / name).string(); }
  CliSameFiles() {
    write_obj(path("mesh.obj"), cube());
    directory.write("places.csv", "face,u,v\n0,0.5,0.25\n3,0,1\n");
    directory.write("points.csv", "x,y,z\n0.3,0.4,0.2\n");
    directory.write("rays.csv", "ox,oy,oz,dx,dy,dz\n0.1,0.2,-5,0,0,1\n");
    directory.write("polygon.csv", "x,y\n0,0\n1,2\n3,1\n4,0\n");
    directory.write("targets.csv", "vertex,x,y,z\n0,-1,-1,-1\n");
    directory.write("rates.csv", "v0,v1,rate\n0,1,3\n");
    directory.write("ball.json", R"({"kind": "implicit", "field": "sphere", "center": [0, 0, 0], "radius": 1})");
    directory.write("shapes.obj",
                    "cstype bezier\ndeg 1 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nsurf 0 1 0 1 1 2 3 4\n"
                    "parm u 0 1\nparm v 0 1\nend\n");
    expect_done(
        sublimit({"bake", path("mesh.obj"), "-s", "catmull-clark", "-l", "1", "-o", path("t.safetensors"), "--quiet"}));
  }
  /// The words with IN and OUT replaced.
  static Words with(Words words, const std::string& in, const std::string& out) {
    for (std::string& word : words) word = word == "IN" ? in : word == "OUT" ? out : word;
    return words;
  }
};

TEST_F(CliSameFiles, InputsThatAreTheOutputAreReplacedAtTheEnd) {
  const std::pair<Words, std::string> rows[] = {
      {{"refine", "IN", "-s", "catmull-clark", "-l", "1", "-o", "OUT"}, "mesh.obj"},
      {{"refine", "IN", "-s", "chaikin", "-l", "1", "-o", "OUT"}, "polygon.csv"},
      {{"refine", "IN", "-l", "1", "-o", "OUT"}, "shapes.obj"},
      {{"limit", "IN", "-s", "catmull-clark", "-o", "OUT"}, "mesh.obj"},
      {{"sample", path("mesh.obj"), "-s", "catmull-clark", "--at", "IN", "-o", "OUT"}, "places.csv"},
      {{"sample", "IN", "-s", "chaikin", "--grid", "3", "-o", "OUT"}, "polygon.csv"},
      {{"closest", path("mesh.obj"), "-s", "catmull-clark", "--points", "IN", "-o", "OUT"}, "points.csv"},
      {{"intersect", path("mesh.obj"), "-s", "catmull-clark", "--rays", "IN", "-o", "OUT"}, "rays.csv"},
      {{"tessellate", "IN", "-s", "catmull-clark", "--chord", "5%", "-o", "OUT"}, "mesh.obj"},
      {{"implicit", path("ball.json"), "--at", "IN", "-o", "OUT"}, "points.csv"},
      {{"apply", path("t.safetensors"), "IN", "-o", "OUT"}, "mesh.obj"},
      {{"fit", "IN", "--targets", path("targets.csv"), "-s", "catmull-clark", "-o", "OUT"}, "mesh.obj"},
  };
  for (const auto& [words, name] : rows) {
    SCOPED_TRACE(::testing::PrintToString(words));
    const std::string extension = fs::path(name).extension().string(), before = read_file(path(name));
    const std::string in = directory.write("in" + extension, before), apart = path("apart" + extension);
    const std::string link = path("link" + extension), twin = path("twin" + extension);
    expect_done(sublimit(with(words, in, apart)));
    const std::string expected = read_file(apart);
    EXPECT_NE(expected, before);
    fs::create_symlink("in" + extension, link);
    for (const auto& [input, output] : {std::pair{in, in}, {link, in}, {in, link}, {link, link}}) {
      directory.write("in" + extension, before);
      expect_done(sublimit(with(words, input, output)));
      EXPECT_TRUE(read_file(in) == expected) << input << " " << output;
      EXPECT_TRUE(fs::is_symlink(link));
    }
    fs::remove(link);
    // A hard link is another name of the input: this one is replaced, that one stays.
    directory.write("in" + extension, before);
    fs::create_hard_link(in, twin);
    expect_done(sublimit(with(words, in, twin)));
    EXPECT_TRUE(read_file(twin) == expected);
    EXPECT_TRUE(read_file(in) == before);
    for (const std::string& file : {in, twin, apart}) fs::remove(file);
  }
}

TEST_F(CliSameFiles, InputsStayWhereWorkFails) {
  directory.write("broken.csv", "face,u,v\n0,0.5,0.25\n99,0,1\n");
  const std::string before = read_file(path("broken.csv"));
  expect_failure(sublimit({"sample", path("mesh.obj"), "-s", "catmull-clark", "--at", path("broken.csv"), "-o",
                           path("broken.csv")}),
                 3, {"broken.csv:3"});
  EXPECT_EQ(read_file(path("broken.csv")), before);
}

TEST_F(CliSameFiles, TwoOutputsAreRefused) {
  const long files = directory.num_files();
  const auto refused = [&](const Words& words, std::initializer_list<std::string_view> parts) {
    expect_failure(sublimit(words), 2, parts);
    EXPECT_EQ(directory.num_files(), files);
  };
  const Words fit{"fit", path("mesh.obj"), "--targets", path("targets.csv"),
                  "-s",  "catmull-clark",  "-o",        path("o.obj")};
  const auto and_more = [](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  // Endings differ between most outputs: links make one file of them.
  fs::create_symlink("o.obj", path("o.json"));
  const long with_link = directory.num_files();
  expect_failure(sublimit(and_more(fit, {"--report", path("o.json")})), 2,
                 {"--output " + path("o.obj") + " and --report " + path("o.json") + " are the same file"});
  EXPECT_EQ(directory.num_files(), with_link);
  fs::remove(path("o.json"));
  fs::create_directory(directory / "sub");
  fs::create_symlink("../x.svg", directory / "sub/x.json");
  expect_failure(sublimit(and_more(fit, {"--report", path("sub/x.json"), "--picture", path("x.svg")})), 2,
                 {"--report", "--picture", "are the same file"});
  fs::remove_all(directory / "sub");
  directory.write("one.svg", "");
  fs::create_hard_link(path("one.svg"), path("one.json"));
  expect_failure(sublimit(and_more(fit, {"--report", path("one.json"), "--picture", path("one.svg")})), 2,
                 {"are the same file"});
  fs::remove(path("one.svg")), fs::remove(path("one.json"));
  fs::create_symlink("m.mtx", path("m.obj"));
  expect_failure(sublimit({"refine", path("mesh.obj"), "-s", "catmull-clark", "-l", "1", "-o", path("m.obj"),
                           "--matrix", path("m.mtx")}),
                 2, {"--output", "--matrix", "are the same file"});
  fs::remove(path("m.obj"));
  refused({"bake", path("mesh.obj"), "-s", "catmull-clark", "-l", "1", "-o", path("x.safetensors"), "--dictionary",
           directory.path().string() + "/./x.safetensors"},
          {"--output", "--dictionary", "are the same file"});
}

TEST_F(CliSameFiles, OtherOutputsAreNoInputs) {
  const std::string ball = read_file(path("ball.json")), rates = read_file(path("rates.csv"));
  expect_failure(sublimit({"implicit", path("ball.json"), "--cells", "4", "--tolerance", "1", "-o", path("o.obj"),
                           "--report", path("ball.json")}),
                 2, {"--report " + path("ball.json") + ": this file is FIELD, which is read"});
  expect_failure(sublimit({"tessellate", path("mesh.obj"), "-s", "catmull-clark", "--rates", path("rates.csv"), "-o",
                           path("o.obj"), "--places", path("rates.csv")}),
                 2, {"--places " + path("rates.csv") + ": this file is --rates, which is read"});
  directory.write("tags.json", "{}");
  expect_failure(sublimit({"step", path("mesh.obj"), "-s", "catmull-clark", "-o", path("o.step"), "--sidecar",
                           path("tags.json"), "--report", path("tags.json")}),
                 2, {"--report", "this file is --sidecar"});
  directory.write("jobs.jsonl", "");
  expect_failure(sublimit({"bake", "--manifest", path("jobs.jsonl"), "--log", path("jobs.jsonl")}), 2,
                 {"--log " + path("jobs.jsonl") + ": this file is --manifest, which is read"});
  EXPECT_EQ(read_file(path("ball.json")), ball);
  EXPECT_EQ(read_file(path("rates.csv")), rates);
  EXPECT_FALSE(fs::exists(directory / "o.obj"));
}

/// What is written in place may not be what is read.
TEST_F(CliSameFiles, StandardOutputIsNoInput) {
  const std::string before = read_file(path("mesh.obj"));
  const Words words{"refine", path("mesh.obj"), "-s", "catmull-clark", "-l", "1", "-o", "-", "--format", "obj"};
  const auto append = [&] { ::dup2(::open(path("mesh.obj").c_str(), O_WRONLY | O_APPEND), STDOUT_FILENO); };
  const Outcome outcome = sublimit(words, append);
  EXPECT_EQ(outcome.status, 2);
  expect_parts(outcome.err, {"--output /dev/stdout.obj: this file is MESH, which is read"});
  EXPECT_EQ(read_file(path("mesh.obj")), before);
  const std::string pipe = path("pipe.csv");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_failure(sublimit({"sample", path("mesh.obj"), "-s", "catmull-clark", "--at", pipe, "-o", pipe}), 2,
                 {"--output " + pipe + ": this file is --at"});
}

/// Devices that anybody may share are no files.
TEST_F(CliSameFiles, DevicesMayBeNamedTwice) {
  fs::create_symlink("/dev/null", path("null.obj"));
  fs::create_symlink("/dev/null", path("null.mtx"));
  expect_done(sublimit({"refine", path("mesh.obj"), "-s", "catmull-clark", "-l", "1", "-o", path("null.obj"),
                        "--matrix", path("null.mtx")}));
}

}  // namespace
}  // namespace sublimit::testing
