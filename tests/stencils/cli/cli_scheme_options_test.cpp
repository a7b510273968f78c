// SPDX-License-Identifier: Apache-2.0
// What the program says when a scheme does not take a mesh or an option, and that doing what it says helps.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/mesh/topology.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit::testing {
namespace {

using Json = nlohmann::json;

/// A mesh file, and the program on it.
class OnMesh {
 public:
  explicit OnMesh(const Mesh& mesh) : mesh_(directory_ / "mesh.obj"), out_(directory_ / "out.obj") {
    write_mesh(mesh_, mesh);
  }
  Outcome run(const std::string& command, const std::string& scheme, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{command, mesh_.string(), "-s", scheme};
    if (command != "info") all.insert(all.end(), {"-o", out_.string()});
    if (command != "info" && std::find(more.begin(), more.end(), "-l") == more.end())
      all.insert(all.end(), {"-l", "1"});
    all.insert(all.end(), more.begin(), more.end());
    return sublimit(all);
  }
  /// Every subcommand refuses: refine and limit with status 3, info with status 1 and in words.
  void expect_refused(const std::string& scheme, std::initializer_list<std::string_view> parts) const {
    SCOPED_TRACE(scheme);
    for (const char* command : {"refine", "limit"}) {
      std::filesystem::remove(out_);
      const Outcome outcome = run(command, scheme);
      expect_failure(outcome, 3, {"mesh.obj", scheme});
      expect_parts(outcome.err, parts);
      EXPECT_EQ(count_of(outcome.err, "\n"), 1u) << outcome.err;
      EXPECT_EQ(directory_.num_files(), 1);
    }
    const Outcome asked = run("info", scheme, {"--json"});
    EXPECT_EQ(asked.status, 1) << asked.err;
    const Json info = Json::parse(asked.out);
    const std::string takes = info["scheme"]["takes_mesh"];
    EXPECT_TRUE(takes.starts_with("no: ")) << takes;
    for (const std::string_view part : parts)  // options are named where a person reads it
      if (!part.starts_with("--")) expect_parts(takes, {part});
  }
  /// Every subcommand takes the mesh with these arguments.
  void expect_taken(const std::string& scheme, const std::vector<std::string>& more) const {
    SCOPED_TRACE(scheme);
    for (const char* command : {"refine", "limit"}) {
      expect_done(run(command, scheme, more));
      EXPECT_GT(read_mesh(out_).num_faces(), 0);
    }
    std::vector<std::string> json = more;
    json.push_back("--json");
    EXPECT_EQ(Json::parse(expect_done(run("info", scheme, json)).out)["scheme"]["takes_mesh"], "yes");
  }
  Mesh result() const { return read_mesh(out_); }

 private:
  TemporaryDirectory directory_;
  std::filesystem::path mesh_, out_;
};

Mesh creased(Mesh mesh, const std::vector<Index>& path, float sharpness) {
  add_crease(mesh, path, sharpness);
  return mesh;
}

TEST(CliTriangulate, IsWhatARefusedPolygonNeeds) {
  const OnMesh polygons(prism(5)), mixed(pole(5));
  for (const Scheme<double>& scheme : all_schemes()) {
    if (scheme.face_size() != 3) continue;
    polygons.expect_refused(scheme.name, {"face 0 has 5 corners", "triangles only", "--triangulate", "catmull-clark"});
    polygons.expect_taken(scheme.name, {"--triangulate"});
    mixed.expect_refused(scheme.name, {"face 1 has 4 corners", "--triangulate"});
    mixed.expect_taken(scheme.name, {"--triangulate"});
  }
}

TEST(CliTriangulate, CutsEveryFaceAndKeepsTags) {
  Mesh mesh = creased(cube(), {0, 4, 6}, 2.5f);
  mesh.corners = {{7, 1.5f}};
  mesh.holes = {5};
  const OnMesh on(mesh);
  expect_done(on.run("refine", "loop", {"--triangulate", "-l", "0"}));
  const Mesh cut = on.result(), expected = triangulated(mesh);
  EXPECT_EQ(cut.face_vertices, expected.face_vertices);
  EXPECT_EQ(cut.holes, (std::vector<Index>{10, 11}));
  ASSERT_EQ(cut.creases.size(), 2u);
  EXPECT_EQ(cut.creases[0].sharpness, 2.5f);
  ASSERT_EQ(cut.corners.size(), 1u);
  const Json info = Json::parse(expect_done(on.run("info", "loop", {"--triangulate", "--json"})).out);
  EXPECT_EQ(info["faces"], 12);
  EXPECT_EQ(info["face_sizes"], Json({{"3", 12}}));
  EXPECT_EQ(info["creases"], 2);
}

TEST(CliNoCreases, IsWhatARefusedCreaseNeeds) {
  const OnMesh infinite(triangulated(creased(cube(), {0, 1, 3, 2, 0}, 10))),
      semi_sharp(triangulated(creased(cube(), {0, 1, 3, 2, 0}, 2))), dart(triangulated(creased(cube(), {0, 1}, 10)));
  for (const Scheme<double>& scheme : all_schemes()) {
    if (scheme.sharpening == Sharpening::semi_sharp) {
      semi_sharp.expect_taken(scheme.name, {});
      continue;
    }
    if (scheme.sharpening == Sharpening::boundary) {
      infinite.expect_refused(scheme.name, {"sharp edge (", "no rule", "--no-creases", "catmull-clark"});
      infinite.expect_taken(scheme.name, {"--no-creases"});
    } else {
      infinite.expect_taken(scheme.name, {});
      semi_sharp.expect_refused(scheme.name, {"sharp edge (", "infinite", "make it 10", "--no-creases"});
      dart.expect_refused(scheme.name, {"end inside", "vertex", "a dart", "has no rule for it; remove"});
      dart.expect_taken(scheme.name, {"--no-creases"});
    }
    semi_sharp.expect_taken(scheme.name, {"--no-creases"});
  }
}

TEST(CliNoCreases, NamesTheEdgeOrVertex) {
  OnMesh(creased(cube(), {2, 3}, 10)).expect_refused("doo-sabin", {"sharp edge (2,3)", "--no-creases"});
  Mesh mesh = triangulated(cube());
  mesh.corners = {{6, 10}};
  const OnMesh corner(mesh);
  for (const char* scheme : {"doo-sabin", "mid-edge", "averaging", "sqrt3", "interpolatory-sqrt3"}) {
    corner.expect_refused(scheme, {"corner 6", "--no-creases"});
    corner.expect_taken(scheme, {"--no-creases"});
  }
}

TEST(CliNoCreases, DropsTheTagsAndNothingElse) {
  Mesh mesh = creased(grid(3, 3), {1, 5, 9, 13}, 3);
  mesh.corners = {{5, 2}};
  mesh.holes = {0};
  mesh.boundary = Boundary::edge_only;
  const OnMesh on(mesh);
  expect_done(on.run("refine", "catmull-clark", {"--no-creases", "-l", "0"}));
  const Mesh plain = on.result();
  EXPECT_EQ(plain.holes, (std::vector<Index>{0}));
  EXPECT_EQ(plain.boundary, Boundary::edge_only);
  const Json info = Json::parse(expect_done(on.run("info", "catmull-clark", {"--no-creases", "--json"})).out);
  EXPECT_EQ(info["creases"], 0);
  EXPECT_EQ(info["corners"], 0);
  EXPECT_EQ(info["holes"], 1);
}

TEST(CliOptions, HelpHasBoth) {
  for (const char* command : {"refine", "limit", "info"})
    expect_parts(expect_done(sublimit({command, "--help"})).out,
                 {"--triangulate", "fan from its first corner", "--no-creases", "crease and corner tags"});
}

TEST(CliOptions, NumbersOutsideTheirRangeAreToldTheRangeAndItsMeaning) {
  const OnMesh on(triangulated(cube()));
  struct Case {
    const char *scheme, *option, *range, *meaning;
    std::vector<std::string> refused, taken;
  };
  const Case cases[] = {
      {"averaging",
       "degree",
       "a whole number from 2 to 9",
       "bidegree",
       {"1", "10", "-3", "2.5", "5/2", "three", "", "3x", "99999999999999999999"},
       {"2", "3", "9"}},
      {"butterfly",
       "tension",
       "from 0 to 2",
       "1 reproduces cubics",
       {"-0.1", "2.1", "21/10", "x", "1/0", "1/-2", "1e0", "nan", ".", "-", "1/2/3", "0.123456789"},
       {"0", "2", "0.75", "3/4", ".5", "1.000000000000", "0.12345678"}},
      {"modified-butterfly",
       "t",
       "from -1/32 to 1/32",
       "eight-point mask",
       {"1/31", "-0.0313", "0.0313"},
       {"1/32", "-1/32", "-0.03125", "0"}},
      {"kobbelt", "tension", "from 0 to 3", "C^1 below 3.08", {"3.01", "-1"}, {"3", "1/3", "0"}},
  };
  for (const Case& c : cases) {
    for (const std::string& value : c.refused)
      expect_failure(on.run("refine", c.scheme, {"--option", c.option + ("=" + value)}), 2,
                     {c.option + ("=" + value) + ":", c.range, c.meaning});
    for (const std::string& value : c.taken)
      expect_done(on.run("refine", c.scheme, {"--option", c.option + ("=" + value)}));
  }
}

TEST(CliOptions, WordsAndNamesThatAreUnknownAreToldTheKnownOnes) {
  const OnMesh on(triangulated(cube()));
  for (const Scheme<double>& scheme : all_schemes()) {
    const Outcome outcome = on.run("refine", scheme.name, {"--option", "colour=red"});
    expect_failure(outcome, 2, {"scheme " + scheme.name + " has no option 'colour'"});
    if (scheme.options.empty()) expect_parts(outcome.err, {"it has none"});
    for (const OptionInfo& info : scheme.options) {
      expect_parts(outcome.err, {info.name});
      if (info.range) continue;
      const Outcome word = on.run("limit", scheme.name, {"--option", info.name + "=colour"});
      expect_failure(word, 2, {info.name + "=colour", info.meaning});
      for (const std::string& value : info.values) expect_parts(word.err, {value});
    }
  }
}

TEST(CliOptions, AreListedWithRangeAndMeaning) {
  const std::string text = expect_done(sublimit({"schemes"})).out;
  expect_parts(text, {"--option degree=2..9 (default 3): ", "--option t=-1/32..1/32 (default 0): ",
                      "--option quads=catmull-clark|edges (default catmull-clark): "});
  const Json json = Json::parse(expect_done(sublimit({"schemes", "--json"})).out);
  for (const Scheme<double>& scheme : all_schemes()) {
    const auto at =
        std::find_if(json.begin(), json.end(), [&](const Json& entry) { return entry["name"] == scheme.name; });
    ASSERT_NE(at, json.end());
    for (const OptionInfo& info : scheme.options) {
      const Json& option = (*at)["options"][info.name];
      EXPECT_NE(info.meaning, "") << scheme.name << ": " << info.name;
      EXPECT_EQ(option["meaning"], info.meaning);
      EXPECT_EQ(option["default"], info.values.front());
      expect_parts(text, {info.name + "=", info.meaning});
      if (info.range) {
        EXPECT_EQ(option["from"], to_string(info.range->low));
        EXPECT_EQ(option["to"], to_string(info.range->high));
        EXPECT_EQ(option["type"], info.range->whole ? "whole number" : "number");
      } else {
        EXPECT_EQ(option["values"], Json(info.values));
      }
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
