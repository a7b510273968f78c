// SPDX-License-Identifier: Apache-2.0
// Files in the wrong place: the message says what the file is and what belongs there, for every subcommand and option
// that reads a file.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/detail/ply.h"

namespace sublimit::testing {
namespace {

using Words = std::vector<std::string>;

/// A file of each kind, and how messages call it.
class Samples {
 public:
  Samples() {
    write_obj(path("mesh.obj"), cube());
    write_ply(path("mesh.ply"), cube());
    expect_done(
        sublimit({"bake", path("mesh.obj"), "-s", "catmull-clark", "-l", "1", "-o", path("table.safetensors")}));
    expect_done(sublimit({"export", path("table.safetensors"), "-o", path("table.npz")}));
    expect_done(sublimit({"export", path("table.safetensors"), "-o", path("table.mtx")}));
    expect_done(sublimit({"apply", path("table.safetensors"), path("mesh.obj"), "-o", path("points.npy")}));
    directory_.write("places.csv", "face,u,v\n0,0.5,0.5\n");
    directory_.write("field.json", R"({"kind": "implicit", "field": {"sphere": 1}})");
    directory_.write("nothing.obj", "");
    directory_.write("cells.vtu", "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\"/>\n");
    directory_.write("picture.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>\n");
    std::filesystem::create_directory(path("folder"));
    num_files_ = directory_.num_files();
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  void expect_nothing_new() const { EXPECT_EQ(directory_.num_files(), num_files_); }

  const std::map<std::string, std::string> words{{"mesh.obj", " is an OBJ file"},
                                                 {"mesh.ply", " is a PLY file"},
                                                 {"table.safetensors", " is a table (safetensors)"},
                                                 {"table.npz", " is a zip archive"},
                                                 {"table.mtx", " is a Matrix Market file"},
                                                 {"points.npy", " is a NumPy array"},
                                                 {"places.csv", " is a CSV file"},
                                                 {"field.json", " is a JSON file"},
                                                 {"cells.vtu", " is a VTK file"},
                                                 {"picture.svg", " is an XML or HTML file"},
                                                 {"nothing.obj", ": empty; "},
                                                 {"folder", ": it is a directory; name a file in it"}};

 private:
  TemporaryDirectory directory_;
  long num_files_ = 0;
};

/// A command line with a place for a file, "?", and the samples that may stand there.
struct Line {
  Words words;
  std::string argument;
  Words right;
};

TEST(CliInputFiles, EachIsKnownInTheWrongPlace) {
  const Samples samples;
  const std::string mesh = samples.path("mesh.obj"), table = samples.path("table.safetensors");
  const Words meshes{"mesh.obj", "mesh.ply"}, shapes{"mesh.obj", "mesh.ply", "places.csv", "field.json", "nothing.obj"};
  const auto with_scheme = [&](Words words) {
    words.insert(words.end(), {"-s", "catmull-clark"});
    return words;
  };
  const std::string csv = samples.path("out.csv"), obj = samples.path("out.obj");
  const std::vector<Line> lines{
      {{"info", "?"}, "MESH", shapes},
      {with_scheme({"refine", "?", "-l", "1", "-o", obj}), "MESH", shapes},
      {with_scheme({"limit", "?", "-o", obj}), "MESH", shapes},
      {with_scheme({"sample", "?", "--grid", "2", "-o", csv}), "MESH", shapes},
      {with_scheme({"sample", mesh, "--at", "?", "-o", csv}), "--at", {"places.csv", "points.npy"}},
      {with_scheme({"closest", mesh, "--points", "?", "-o", csv}),
       "--points",
       {"places.csv", "points.npy", "mesh.obj", "mesh.ply"}},
      {with_scheme({"intersect", mesh, "--rays", "?", "-o", csv}), "--rays", {"places.csv", "points.npy"}},
      {with_scheme({"tessellate", "?", "--chord", "1%", "-o", obj}), "MESH", shapes},
      {with_scheme({"tessellate", mesh, "--rates", "?", "-o", obj}), "--rates", {"places.csv", "points.npy"}},
      {with_scheme({"step", "?", "-o", samples.path("out.step")}), "MESH", shapes},
      {with_scheme({"bake", "?", "-l", "1", "-o", samples.path("out.safetensors")}), "MESH", shapes},
      {with_scheme({"bake", mesh, "--at", "?", "-o", samples.path("out.safetensors")}),
       "--at",
       {"places.csv", "points.npy"}},
      {with_scheme({"bake", mesh, "--tessellation", "?", "-o", samples.path("out.safetensors")}),
       "--tessellation",
       {"mesh.ply"}},
      {{"bake", "--manifest", "?"}, "--manifest", {"field.json", "nothing.obj"}},
      {with_scheme({"bake", mesh, "-l", "1", "--dictionary", "?", "-o", samples.path("out.safetensors")}),
       "--dictionary",
       {"table.safetensors", "folder"}},
      {{"construct", "?", "-o", obj}, "RECIPE", {"field.json"}},
      {{"implicit", "?", "-o", obj}, "FIELD", {"field.json"}},
      {{"apply", "?", samples.path("points.npy"), "-o", obj}, "TABLE", {"table.safetensors"}},
      {{"apply", table, "?", "-o", obj}, "POINTS", {"mesh.obj", "mesh.ply", "places.csv", "points.npy", "field.json"}},
      {{"export", "?", "-o", samples.path("out.npz")}, "TABLE", {"table.safetensors"}},
      {with_scheme({"analyze", "?"}), "MESH", shapes},
      {with_scheme({"fit", mesh, "--targets", "?", "-o", obj}), "--targets", {"places.csv", "points.npy"}},
      {with_scheme({"fit", mesh, "--cloud", "?", "-o", obj}),
       "--cloud",
       {"places.csv", "points.npy", "mesh.obj", "mesh.ply"}},
  };
  size_t turn = 0;  // a third of the kinds for each place, and each kind in a third of the places
  for (const Line& line : lines)
    for (const auto& [name, kind] : samples.words) {
      if (++turn % 3 != 0 || std::ranges::find(line.right, name) != line.right.end()) continue;
      Words words = line.words;
      std::ranges::replace(words, std::string("?"), samples.path(name));
      SCOPED_TRACE(line.words[0] + " " + line.argument + " " + name);
      const Outcome outcome = sublimit(words);
      expect_failure(outcome, 3, {name + kind, line.argument + " is "});
      EXPECT_EQ(count_of(outcome.err, "\n"), 1u) << outcome.err;
      samples.expect_nothing_new();
    }
}

TEST(CliInputFiles, SwappedArgumentsAreSeen) {
  const Samples samples;
  const std::string mesh = samples.path("mesh.obj"), table = samples.path("table.safetensors");
  expect_failure(
      sublimit({"apply", mesh, table, "-o", samples.path("out.obj")}), 3,
      {mesh + " is an OBJ file and " + table + " is a table (safetensors): they are swapped; TABLE is ", "POINTS is "});
  expect_failure(
      sublimit({"closest", samples.path("points.npy"), "--points", mesh, "-s", "loop", "-o", samples.path("out.csv")}),
      3, {"they are swapped", "MESH is ", "--points is "});
  samples.expect_nothing_new();
}

TEST(CliInputFiles, VerifyAnswersByItsVerdict) {
  const Samples samples;
  for (const auto& [name, kind] : samples.words) {
    if (name == "table.safetensors" || name == "folder") continue;
    const Outcome outcome = sublimit({"verify", samples.path(name)});
    if (name == "field.json") {
      expect_failure(outcome, 3, {name});  // no report, and written as one
      continue;
    }
    EXPECT_EQ(outcome.status, 1) << name;
    EXPECT_EQ(outcome.err, "");
    expect_parts(outcome.out, {name});
    if (name != "nothing.obj") expect_parts(outcome.out, {"it" + kind + ", neither a table nor a report"});
  }
  expect_failure(sublimit({"verify", samples.path("folder")}), 3, {"folder: it is a directory"});
}

// What is read from a pipe is gone: it is not looked at before.
TEST(CliInputFiles, PipesAreReadOnce) {
  const TemporaryDirectory directory;
  const std::string pipe = (directory / "mesh.obj").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  Program program({"info", pipe, "-s", "catmull-clark", "--json"});
  const int writer = ::open(pipe.c_str(), O_WRONLY);
  const std::string text = format_obj(cube());
  EXPECT_EQ(::write(writer, text.data(), text.size()), ssize_t(text.size()));
  ::close(writer);
  expect_parts(expect_done(program.wait()).out, {"\"vertices\": 8"});
}

}  // namespace
}  // namespace sublimit::testing
