// SPDX-License-Identifier: Apache-2.0
// What `sublimit analyze` refuses: the exit status, a message that says what, where and what would be right, no output.
#include <gtest/gtest.h>

#include <fstream>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

using Parts = std::initializer_list<std::string_view>;

/// Runs `analyze` with outputs in an empty directory, where it must leave nothing.
void expect_analysis_refused(std::vector<std::string> arguments, int status, Parts parts) {
  const TemporaryDirectory directory;
  std::string trace;
  for (const std::string& argument : arguments) trace += " '" + argument + "'";
  SCOPED_TRACE(trace);
  arguments.insert(arguments.begin(), "analyze");
  for (const auto& [option, name] : {std::pair{"-o", "r.html"}, {"--json", "r.json"}})
    if (std::ranges::find(arguments, option) == arguments.end())
      arguments.insert(arguments.end(), {option, (directory / name).string()});
  const Outcome outcome = sublimit(arguments);
  expect_failure(outcome, status, parts);
  EXPECT_TRUE(outcome.err.starts_with("sublimit: ") || outcome.err.starts_with("sublimit analyze: ")) << outcome.err;
  EXPECT_EQ(count_of(outcome.err, "\n"), 1u) << outcome.err;
  EXPECT_EQ(directory.num_files(), 0);
}

TEST(CliAnalyzeErrors, TagsBesideTheMeshAreNotOverwritten) {
  const TemporaryDirectory directory;
  Mesh cage;
  cage.positions = cube().positions;
  cage.face_sizes = cube().face_sizes;
  cage.face_vertices = cube().face_vertices;
  write_obj(directory / "cage.obj", cage);
  const std::string tags = (directory / "cage.json").string(), text = "{\"holeIndices\": [3]}";
  std::ofstream(tags) << text;
  const Outcome outcome =
      sublimit({"analyze", (directory / "cage.obj").string(), "-s", "catmull-clark", "--json", tags});
  expect_failure(outcome, 2, {"--json " + tags, "holds tags of", "choose another name"});
  EXPECT_EQ(read_file(tags), text);
}

TEST(CliAnalyzeErrors, ValencesThatMakeNoSense) {
  const auto refused = [](const std::string& valences, Parts parts) {
    expect_analysis_refused({"-s", "loop", "--valence", valences}, 2, parts);
  };
  refused("2-5", {"--valence 2-5", "2 is below 3"});
  refused("5-3", {"5-3 is empty", "did you mean 3-5?"});
  refused("a", {"'a' is no number", "3-12 or 3-8,12"});
  refused("", {"--valence is given an empty word"});
  refused("3-", {"3-", "no number"});
  refused("3,,4", {"3,,4", "no number"});
  refused("3-1000", {"1000 is beyond 100", "GB of memory", "hours", "3-100"});
  refused("99999999999999999999", {"99999999999999999999 is beyond 100"});
}

TEST(CliAnalyzeErrors, SchemesAndOptions) {
  expect_analysis_refused({}, 2, {"name a scheme with -s", "all"});
  expect_analysis_refused({"-s", "lop"}, 2, {"unknown scheme 'lop'", "nearest are loop"});
  expect_analysis_refused({"-s", "four-pint", "--sweep", "tension=0:1:1"}, 2,
                          {"'four-pint'", "nearest are four-point"});
  expect_analysis_refused({"-s", "hermite-incentre"}, 2, {"hermite-incentre", "not linear", "gallery"});
  expect_analysis_refused({"-s", "hermite-incentre", "--sweep", "tension=0:1:1"}, 2, {"not linear"});
  expect_analysis_refused({"-s", "averaging", "--option", "degree=99"}, 2, {"degree=99", "from 2 to 9"});
  expect_analysis_refused({"-s", "loop", "--option", "degree=3"}, 2, {"loop has no option 'degree'"});
  expect_analysis_refused({"-s", "loop", "--option", "degree"}, 2, {"name=value"});
  expect_analysis_refused({"-s", "all", "--option", "degree=3"}, 2, {"--option belongs to one scheme"});
  expect_analysis_refused({"-s", "all", "--claim", "regular=2"}, 2, {"--claim belongs to one scheme"});
  expect_analysis_refused({"-s", "loop", "--claim", "smooth=2"}, 2, {"no such claim", "regular=N"});
  expect_analysis_refused({"-s", "loop", "--claim", "regular=two"}, 2, {"whole number"});
}

TEST(CliAnalyzeErrors, MasksAndSweeps) {
  expect_analysis_refused({"--mask", ""}, 2, {"--mask is given an empty word"});
  expect_analysis_refused({"--mask", " "}, 2, {"at least 2 weights", "1 4 6 4 1 /8"});
  expect_analysis_refused({"--mask", "1"}, 2, {"at least 2 weights", "there is 1"});
  expect_analysis_refused({"--mask", "1 2 x"}, 2, {"weight 3", "'x'"});
  expect_analysis_refused({"--mask", "1 2 1 /0"}, 2, {"'/0'", "denominator"});
  expect_analysis_refused({"--mask", "0 0 0"}, 2, {"all weights are zero"});
  const auto refused = [](const std::string& sweep, Parts parts) {
    expect_analysis_refused({"-s", "four-point", "--sweep", sweep}, 2, parts);
  };
  refused("", {"--sweep is given an empty word"});
  refused("tension", {"=", "tension=0:4:0.05"});
  refused("tension=0:4", {"2 numbers instead of 3"});
  refused("tension=4:0:1", {"the last value is before the first"});
  refused("tension=0:4:0", {"the step must be positive"});
  refused("tension=a:4:1", {"'a' is not a number"});
  refused("tension=0:4:0.0001", {"more than 2001 values"});
  refused("degree=0:4:1", {"four-point has no option 'degree'"});
  expect_analysis_refused({"-s", "all", "--sweep", "tension=0:1:1"}, 2, {"one scheme"});
}

TEST(CliAnalyzeErrors, JobsThatDoNotGoTogether) {
  expect_analysis_refused({"--mask", "1 2 1 /2", "--sweep", "tension=0:1:1"}, 2, {"give one of them"});
  expect_analysis_refused({"mesh.obj", "-s", "loop", "--mask", "1 2 1 /2"}, 2, {"give one of them"});
  expect_analysis_refused({"--mask", "1 2 1 /2", "-s", "loop"}, 2, {"--scheme is for", "a mask"});
  expect_analysis_refused({"-s", "loop", "--tolerance", "g1=1"}, 2, {"--tolerance is for meshes"});
  expect_analysis_refused({"mesh.obj", "-s", "loop", "--valence", "3"}, 2, {"--valence is for schemes"});
  expect_analysis_refused({"-s", "chaikin", "--valence", "3"}, 2, {"--valence", "chaikin refines curves"});
  expect_analysis_refused({"mesh.obj", "-s", "all"}, 2, {"one scheme"});
  expect_analysis_refused({"mesh.obj"}, 2, {"name a scheme"});
}

TEST(CliAnalyzeErrors, MeshesAndCurves) {
  const TemporaryDirectory directory;
  write_obj(directory / "cube.obj", cube());
  const std::string mesh = (directory / "cube.obj").string();
  expect_analysis_refused({mesh, "-s", "loop"}, 3, {"cube.obj", "loop", "face 0", "4 corners", "triangles"});
  expect_analysis_refused({(directory / "none.obj").string(), "-s", "loop"}, 3, {"none.obj", "No such file"});
  expect_analysis_refused({directory.write("bad.obj", "v 0 0\n").string(), "-s", "loop"}, 3, {"bad.obj:1"});
  expect_analysis_refused({(directory / "none.csv").string()}, 3, {"none.csv", "No such file"});
  expect_analysis_refused({directory.write("bad.csv", "a,b\n").string()}, 3, {"bad.csv", "line 1", "piece,x,y"});
  for (const char* tolerance : {"g1", "g1=abc", "g3=1", "g1=-1deg", "g0=1deg"})
    expect_analysis_refused({mesh, "-s", "catmull-clark", "--tolerance", tolerance}, 2, {tolerance, "g1=0.1deg"});
}

TEST(CliAnalyzeErrors, OutputsAreCheckedBeforeWorkStarts) {
  const TemporaryDirectory directory;
  const std::string missing = (directory / "missing.obj").string();  // what is wrong with the output is told first
  const auto refused = [&](const char* option, const std::string& path, int status, Parts parts) {
    expect_analysis_refused({missing, "-s", "loop", option, path}, status, parts);
  };
  refused("-o", (directory / "r.pdf").string(), 2, {"r.pdf", ".html or .htm"});
  refused("--json", (directory / "r.html").string(), 2, {"r.html", ".json"});
  refused("--picture", (directory / "r.png").string(), 2, {"r.png", ".svg"});
  refused("-o", (directory / "none" / "r.html").string(), 3, {"r.html", "is not a directory"});
  std::filesystem::create_directory(directory / "folder.json");
  refused("--json", (directory / "folder.json").string(), 3, {"folder.json", "directory"});
  directory.write("file", "");
  expect_analysis_refused({"-s", "loop", "--export", (directory / "file").string()}, 3,
                          {"cannot make the directory", "file"});
  EXPECT_EQ(directory.num_files(), 2);
}

}  // namespace
}  // namespace sublimit::testing
