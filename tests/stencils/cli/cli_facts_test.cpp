// SPDX-License-Identifier: Apache-2.0
// `--json`: what subcommands tell at the end, as an object that says what their sentences say.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "stencils/subcommands.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

using Words = std::vector<std::string>;
using Json = nlohmann::ordered_json;

struct CliFacts : ::testing::Test {
  TemporaryDirectory directory;
  std::string path(const std::string& name) const { return (directory / name).string(); }
  std::string mesh = path("mesh.obj");
  CliFacts() {
    write_obj(mesh, cube());
    directory.write("points.csv", "x,y,z\n0.3,0.4,0.2\n9,0,0\n");
    directory.write("rays.csv", "ox,oy,oz,dx,dy,dz\n0.1,0.2,-5,0,0,1\n");
    directory.write("polygon.csv", "x,y\n0,0\n1,2\n3,1\n4,0\n");
    directory.write("places.csv", "face,u,v\n0,2,0.5\n");
    directory.write("targets.csv", "vertex,x,y,z\n0,-1,-1,-1\n");
    directory.write(
        "cone.json",
        R"({"kind": "cone", "curve": {"degree": 1, "knots": [0, 0, 1, 1], "points": [[1, 0], [0, 1]]}, "apex": [0, 0, 2]})");
    directory.write("ball.json", R"({"kind": "implicit", "field": "sphere", "center": [0, 0, 0], "radius": 1})");
    expect_done(sublimit({"bake", mesh, "-s", "catmull-clark", "-l", "1", "-o", path("t.safetensors"), "--quiet"}));
  }
};

/// Whether each whole number and text of the object stands in the sentences.
void expect_told(const Json& object, const std::string& text) {
  for (const auto& [name, value] : object.items()) {
    if (name == "verb" || name.ends_with("_bytes") || name == "seconds" || name == "derivatives" || name == "frames")
      continue;  // these have other words
    if (value.is_number_integer() && value != 0) {
      EXPECT_NE(text.find(value.dump()), std::string::npos) << name << " " << value << " in " << text;
    }
    if (value.is_string()) {
      EXPECT_NE(text.find(value.get<std::string>()), std::string::npos) << name << " " << value << " in " << text;
    }
  }
}

TEST_F(CliFacts, AreTheSameAsTextAndAsAnObject) {
  const std::pair<Words, std::set<std::string>> rows[] = {
      {{"limit", mesh, "-s", "catmull-clark", "-o", path("o.obj")}, {"points", "level", "types", "sides"}},
      {{"limit", path("polygon.csv"), "-s", "chaikin", "--normals", "-o", path("o.csv")},
       {"points", "without_tangent"}},
      {{"sample", mesh, "-s", "catmull-clark", "--grid", "3", "-o", path("o.csv")}, {"samples", "status", "types"}},
      {{"sample", mesh, "-s", "catmull-clark", "--at", path("places.csv"), "--clamp", "-o", path("o.csv")},
       {"samples", "clamped"}},
      {{"sample", path("cone.json"), "--grid", "3", "-o", path("o.csv")}, {"samples", "faces", "surfaces"}},
      {{"sample", path("polygon.csv"), "-s", "chaikin", "--grid", "3", "-o", path("o.csv")}, {"samples"}},
      {{"closest", mesh, "-s", "catmull-clark", "--points", path("points.csv"), "-o", path("o.csv")},
       {"points", "least_distance", "largest_distance", "bound_below"}},
      {{"intersect", mesh, "-s", "catmull-clark", "--rays", path("rays.csv"), "-o", path("o.csv")}, {"hits", "rays"}},
      {{"tessellate", mesh, "-s", "catmull-clark", "--chord", "5%", "-o", path("o.obj")},
       {"triangles", "points", "cells", "bound", "surface", "median_aspect_ratio", "largest_aspect_ratio"}},
      {{"step", mesh, "-s", "catmull-clark", "-o", path("o.step")},
       {"solids", "faces", "caps", "valid", "deviation", "unit", "tolerance_met"}},
      {{"step", path("cone.json"), "-o", path("o.step")}, {"solids", "faces", "shared_edges", "gap", "degrees"}},
      {{"bake", mesh, "-s", "catmull-clark", "-l", "1", "-o", path("o.safetensors")},
       {"points", "control_points", "memory_bytes", "file_bytes", "seconds", "precision"}},
      {{"bake", mesh, "-s", "catmull-clark", "-l", "3", "--plan"}, {"points", "table_bytes", "memory_bytes"}},
      {{"apply", path("t.safetensors"), mesh, "-o", path("o.obj")}, {"points", "frames", "derivatives", "seconds"}},
      {{"construct", path("cone.json"), "-o", path("o.obj")}, {"surfaces", "control_points"}},
      {{"implicit", path("ball.json"), "--cells", "4", "--tolerance", "1", "-o", path("o.obj")},
       {"faces", "components", "largest_distance", "tolerance", "tolerance_met", "notes"}},
      {{"implicit", path("ball.json"), "--at", path("points.csv"), "-o", path("o.csv")}, {"places", "field"}},
      {{"verify", path("t.safetensors")}, {"sound", "row_sums", "file_bytes", "points", "scheme", "tool"}},
  };
  std::set<std::string> seen;
  for (const auto& [words, members] : rows) {
    SCOPED_TRACE(::testing::PrintToString(words));
    const std::string& verb = words.front();
    seen.insert(verb);
    const std::string text = expect_done(sublimit(words), true).out;
    Words with_json = words;
    with_json.push_back("--json");
    const Json object = Json::parse(expect_done(sublimit(with_json), true).out);
    EXPECT_EQ(object["verb"], verb);
    if (const auto output = std::ranges::find(words, "-o"); output != words.end()) {
      EXPECT_EQ(object["output"], *(output + 1));
    }
    for (const std::string& member : members) EXPECT_TRUE(object.contains(member)) << member << " in " << object.dump();
    expect_told(object, text);
    with_json.push_back("--quiet");
    const std::string quietly = expect_done(sublimit(with_json)).out;
    EXPECT_EQ(Json::parse(quietly).size(), object.size()) << "warnings are quiet, what is asked for is not";
  }
  // Those that have objects of their own.
  for (const char* const verb : {"info", "schemes", "devices", "analyze", "refine", "fit"}) seen.insert(verb);
  // Those that tell nothing that they do not write.
  for (const char* const verb : {"export", "demo", "help", "flatten"}) seen.insert(verb);
  std::set<std::string> all = subcommands();
  all.insert("flatten");
  EXPECT_EQ(seen, all);
}

TEST_F(CliFacts, RefineHasThemAlone) {
  const Words words{"refine", mesh, "-s", "catmull-clark", "-l", "2", "-o", path("o.obj")};
  EXPECT_EQ(expect_done(sublimit(words)).out, "");
  Words with_json = words;
  with_json.push_back("--json");
  EXPECT_EQ(Json::parse(expect_done(sublimit(with_json)).out),
            (Json{{"verb", "refine"}, {"output", path("o.obj")}, {"level", 2}, {"vertices", 98}, {"faces", 96}}));
}

TEST_F(CliFacts, FitsPrintTheirReport) {
  const Words words{"fit", mesh,          "--targets", path("targets.csv"), "-s",    "catmull-clark",
                    "-o",  path("o.obj"), "--report",  path("r.json"),      "--json"};
  const std::string out = expect_done(sublimit(words)).out;
  EXPECT_EQ(out, read_file(path("r.json")));
}

TEST_F(CliFacts, VerdictsThatAreNoAreObjectsToo) {
  std::string table = read_file(path("t.safetensors"));
  table[table.size() - 3] ^= 1;
  const std::string broken = directory.write("broken.safetensors", table);
  const Json object = Json::parse(expect_no(sublimit({"verify", broken, "--json"})).out);
  EXPECT_EQ(object["sound"], false);
  EXPECT_EQ(object["file"], broken);
  ASSERT_FALSE(object["findings"].empty());
  expect_parts(expect_no(sublimit({"verify", broken})).out, {object["findings"][0].get<std::string>()});
}

TEST_F(CliFacts, GoToStandardErrorWhereAFileGoesToStandardOutput) {
  const Outcome outcome = sublimit({"limit", mesh, "-s", "catmull-clark", "-o", "-", "--format", "off", "--json"});
  EXPECT_TRUE(outcome.out.starts_with("OFF"));
  EXPECT_EQ(Json::parse(outcome.err)["output"], "/dev/stdout.off");
}

}  // namespace
}  // namespace sublimit::testing
