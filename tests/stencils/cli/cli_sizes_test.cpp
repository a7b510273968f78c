// SPDX-License-Identifier: Apache-2.0
// Numbers that no machine has room for, and outputs that cannot be: told at once, before any work, with what would be
// right.
#include <chrono>

#include "meshes/meshes.h"
#include "stencils/cli_tables.h"

namespace sublimit::testing {
namespace {

using namespace std::string_literals;

/// Seconds that a refusal may take on a slow machine that others use too; the work itself would never end.
constexpr double at_once = 3;

class Refusals {
 public:
  Refusals() {
    write_obj(path("mesh.obj"), cube());
    directory.write("line.csv", "0,0\n1,0\n1,1\n0,2\n");
    directory.write("targets.csv", "vertex,x,y,z\n0,1,1,1\n");
    std::filesystem::create_directory(path("folder"));
    std::filesystem::create_directory(path("folder.obj"));
    files = directory.num_files();
  }
  std::string path(const std::string& name) const { return (directory / name).string(); }
  /// Refused with this status, at once, in finite numbers, and without a trace.
  void expect(int status, const std::vector<std::string>& arguments,
              std::initializer_list<std::string_view> parts) const {
    std::string trace;
    for (const std::string& word : arguments) trace += " " + word;
    SCOPED_TRACE(trace);
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = sublimit(arguments);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    expect_failure(outcome, status, parts);
    EXPECT_LT(time.count(), at_once);
    for (const char* odd : {" inf ", " nan ", "fault of ours"})
      EXPECT_EQ(outcome.err.find(odd), std::string::npos) << outcome.err;
    EXPECT_LT(outcome.err.size(), 400 + 2 * directory.path().string().size()) << outcome.err;
    EXPECT_EQ(directory.num_files(), files);
  }
  TemporaryDirectory directory;
  long files = 0;
};

TEST(CliSizes, LevelsBeyondAnyMemory) {
  const Refusals refusals;
  const auto& path = [&](const char* name) { return refusals.path(name); };
  for (const char* scheme : {"catmull-clark", "doo-sabin", "mid-edge", "averaging", "kobbelt"})
    for (const char* verb : {"refine", "limit"})
      for (const char* levels : {"100", "2000000000"})
        refusals.expect(4, {verb, path("mesh.obj"), "-s", scheme, "-l", levels, "-o", path("out.ply")},
                        {levels, "levels", "use at most "});
  for (const char* scheme : {"chaikin", "four-point"})
    for (const char* verb : {"refine", "limit"})
      refusals.expect(4, {verb, path("line.csv"), "-s", scheme, "-l", "2000000000", "-o", path("out.csv")},
                      {"2000000000 levels", "use at most "});
  for (const char* levels : {"12", "2000000000"})
    for (const char* limit : {"--limit", "--quiet"})
      refusals.expect(
          2, {"bake", path("mesh.obj"), "-s", "catmull-clark", "-l", levels, limit, "-o", path("out.safetensors")},
          {levels, "to 11 are right"});
  refusals.expect(2, {"bake", path("mesh.obj"), "-s", "catmull-clark", "-l", "2000000000", "--plan"},
                  {"to 11 are right"});
}

TEST(CliSizes, LevelsThatAreNone) {
  const Refusals refusals;
  const auto& path = [&](const char* name) { return refusals.path(name); };
  for (const char* levels : {"-1", "1.5", "99999999999999999999", "two", "nan"})
    for (const auto& [verb, out] : {std::pair("refine", "out.obj"), {"limit", "out.obj"}, {"bake", "out.safetensors"}})
      refusals.expect(2, {verb, path("mesh.obj"), "-s", "catmull-clark", "-l", levels, "-o", path(out)}, {levels});
}

TEST(CliSizes, PlacesBeyondAnyMemory) {
  const Refusals refusals;
  const auto& path = [&](const char* name) { return refusals.path(name); };
  for (const char* count : {"2000000000", "9223372036854775807", "99999999999999999999"}) {
    refusals.expect(4, {"sample", path("mesh.obj"), "-s", "catmull-clark", "--grid", count, "-o", path("out.csv")},
                    {"--grid", "use fewer"});
    refusals.expect(4,
                    {"sample", path("mesh.obj"), "-s", "catmull-clark", "--random",
                     count == "2000000000"s ? "2000000000000000" : count, "-o", path("out.csv")},
                    {"--random", "use fewer"});
  }
  for (const char* count : {"-1", "1", "1.5", "many"})
    refusals.expect(2, {"sample", path("mesh.obj"), "-s", "catmull-clark", "--grid", count, "-o", path("out.csv")},
                    {"--grid", count, "2 or more"});
  for (const char* count : {"-1", "1.5", "many"})
    refusals.expect(2, {"sample", path("mesh.obj"), "-s", "catmull-clark", "--random", count, "-o", path("out.csv")},
                    {"--random", count, "0 or more"});
  for (const char* count : {"-1", "1", "1.5", "2049", "2000000000", "99999999999999999999"})
    refusals.expect(
        2, {"bake", path("mesh.obj"), "-s", "catmull-clark", "--grid", count, "-o", path("out.safetensors")}, {count});
}

// Whatever its name ends in, and whatever else is missing.
TEST(CliOutput, ThatIsAFolder) {
  const Refusals refusals;
  const auto& path = [&](const std::string& name) { return refusals.path(name); };
  const std::string mesh = path("mesh.obj"), missing = path("missing.obj"), good = path("out.obj");
  for (const std::string& folder : {path("folder"), path("folder.obj"), path("folder/")}) {
    const auto expect = [&](const std::vector<std::string>& arguments) {
      refusals.expect(3, arguments, {folder, "it is a directory", "name a file in it"});
    };
    for (const std::string& in : {mesh, missing}) {
      for (const char* verb : {"refine", "limit"}) expect({verb, in, "-s", "catmull-clark", "-l", "1", "-o", folder});
      expect({"refine", in, "-s", "catmull-clark", "-l", "1", "-o", good, "--matrix", folder});
      expect({"sample", in, "-s", "catmull-clark", "--grid", "3", "-o", folder});
      expect({"bake", in, "-s", "catmull-clark", "-l", "1", "-o", folder});
      expect({"fit", in, "--targets", path("targets.csv"), "-s", "catmull-clark", "-o", folder});
      for (const char* option : {"--report", "--picture"})
        expect({"fit", in, "--targets", path("targets.csv"), "-s", "catmull-clark", "-o", good, option, folder});
      for (const char* option : {"-o", "--json", "--picture"})
        expect({"analyze", in, "-s", "catmull-clark", option, folder});
    }
    for (const char* verb : {"refine", "limit"})
      expect({verb, path("line.csv"), "-s", "chaikin", "-l", "1", "-o", folder});
    expect({"analyze", "-s", "catmull-clark", "-o", folder});
    expect({"apply", path("missing.safetensors"), mesh, "-o", folder});
  }
  refusals.expect(3, {"export", path("missing.safetensors"), "-o", path("folder.obj")}, {"it is a directory"});
  refusals.directory.write("jobs.jsonl",
                           R"({"mesh": "mesh.obj", "scheme": "loop", "levels": 1, "output": "a.safetensors"})");
  const Outcome log = sublimit({"bake", "--manifest", path("jobs.jsonl"), "--log", path("folder")});
  expect_failure(log, 3, {"folder", "cannot write", "directory"});
  EXPECT_FALSE(std::filesystem::exists(path("a.safetensors")));
}

TEST(CliOutput, ThatIsTheInputIsReplacedWhole) {
  const TemporaryDirectory directory;
  const std::string mesh = (directory / "mesh.obj").string();
  write_obj(mesh, cube());
  expect_done(sublimit({"refine", mesh, "-s", "catmull-clark", "-l", "1", "-o", mesh}));
  EXPECT_EQ(read_mesh(mesh).num_faces(), 24);
  expect_done(sublimit({"limit", mesh, "-s", "catmull-clark", "-o", mesh, "--quiet"}));
  EXPECT_EQ(read_mesh(mesh).num_faces(), 24);
  const std::string places = directory.write("places.csv", "face,u,v\n0,0.5,0.5\n3,0.25,0\n").string();
  expect_done(sublimit({"sample", mesh, "-s", "catmull-clark", "--at", places, "-o", places, "--quiet"}));
  EXPECT_TRUE(read_file(places).starts_with("face,u,v,status"));
  EXPECT_EQ(directory.num_files(), 2);
}

}  // namespace
}  // namespace sublimit::testing
