// SPDX-License-Identifier: Apache-2.0
// Recipes of kinds `nielson` and `piper` are the surfaces of meshes with normals, wherever these are taken.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "stencils/cli_program.h"
#include "stencils/recipes/recipe_samples.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

/// An eighth of the unit sphere and its mirror image, with normals of any length.
const std::string two_triangles =
    "v 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 -1\nvn 2 0 0\nvn 0 0.3 0\nvn 0 0 1\nvn 0 0 -1\n"
    "f 1//1 2//2 3//3\nf 2//2 1//1 4//4\n";
const std::string one_triangle =
    "v 1 0 0.125\nv 0.1 1 0\nv 0 0 1\nvn 1 0.1 0.2\nvn 0 3 0.7\nvn 0 -0.1 1\nf 1//1 2//2 3//3\n";
const std::string same_triangle =
    R"("points": [[1, 0, "1/8"], [0.1, 1, 0], [0, 0, 1]], "normals": [[1, 0.1, 0.2], [0, 3, 0.7], [0, -0.1, 1]]})";

std::string recipe_of(const std::string& kind, const std::string& fields) {
  return R"({"kind": ")" + kind + "\", " + fields;
}

class NormalRecipes : public ::testing::Test {
 protected:
  std::string output(const std::vector<std::string>& arguments, const char* name = "out.csv") const {
    std::vector<std::string> all = arguments;
    const std::string out = (directory_ / name).string();
    all.insert(all.end(), {"-o", out});
    expect_done(sublimit(all));
    return read_file(out);
  }
  std::string write(const std::string& name, const std::string& text) const {
    return directory_.write(name, text).string();
  }
  TemporaryDirectory directory_;
};

TEST_F(NormalRecipes, OfATriangleAreTheMeshBitForBit) {
  const std::string mesh = write("t.obj", one_triangle);
  for (const char* kind : {"nielson", "piper"}) {
    SCOPED_TRACE(kind);
    const std::string recipe = write("r.json", recipe_of(kind, same_triangle));
    const auto same = [&](const std::vector<std::string>& what, const char* name) {
      const auto with = [&](const std::vector<std::string>& input) {
        std::vector<std::string> all{what[0]};
        all.insert(all.end(), input.begin(), input.end());
        all.insert(all.end(), what.begin() + 1, what.end());
        return output(all, name);
      };
      EXPECT_EQ(with({recipe}), with({mesh, "-s", kind})) << what[0];
    };
    same({"sample", "--grid", "9", "--derivatives", "2", "--curvature"}, "out.csv");
    same({"sample", "--random", "500", "--seed", "3", "--derivatives", "1"}, "out.csv");
    const std::string at = write("at.csv", "face,u,v\n0,0.25,0.5\n0,0,1\n");
    same({"sample", "--at", at, "--derivatives", "1"}, "out.csv");
    same({"refine", "-l", "3"}, "out.obj");
    same({"limit", "-l", "2", "--normals"}, "out.ply");
  }
}

TEST_F(NormalRecipes, NameAMeshBesideThem) {
  std::filesystem::create_directory(directory_ / "parts");
  const std::string mesh = write("parts/sphere.obj", two_triangles),
                    recipe = write("parts/r.json", recipe_of("piper", R"("mesh": "sphere.obj"})")),
                    above = write("r.json", recipe_of("piper", R"("mesh": "parts/sphere.obj"})"));
  const std::string expected = output({"sample", mesh, "-s", "piper", "--grid", "5", "--derivatives", "2"});
  for (const std::string& file : {recipe, above})
    EXPECT_EQ(output({"sample", file, "--grid", "5", "--derivatives", "2"}), expected);
  const std::string estimated =
      write("r.json", recipe_of("piper", R"("mesh": "parts/sphere.obj", "normals": "estimated"})"));
  EXPECT_EQ(output({"sample", estimated, "--grid", "5"}),
            output({"sample", mesh, "-s", "piper", "--option", "normals=estimated", "--grid", "5"}));
}

TEST_F(NormalRecipes, SeveralFollowEachOther) {
  const std::string mesh = write("sphere.obj", two_triangles), triangle = write("t.obj", one_triangle),
                    recipe = write("r.json", R"({"recipes": [)" + recipe_of("piper", R"("mesh": "sphere.obj"}, )") +
                                                 recipe_of("nielson", same_triangle) + "]}");
  // Faces 0 and 1 are of the first, face 2 of the second.
  const auto rows = [&](const std::string& in, const std::string& scheme, int face) {
    std::vector<std::string> all{"sample", in, "--grid", "4", "--derivatives", "2"};
    if (!scheme.empty()) all.insert(all.end(), {"-s", scheme});
    std::istringstream lines(output(all));
    std::string found;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(std::to_string(face) + ",")) found += line.substr(2) + "\n";
    EXPECT_EQ(count_of(found, "\n"), 10u);
    return found;
  };
  for (const int face : {0, 1}) EXPECT_EQ(rows(recipe, "", face), rows(mesh, "piper", face));
  EXPECT_EQ(rows(recipe, "", 2), rows(triangle, "nielson", 0));
  // Places in any order.
  const std::string at = write("at.csv", "face,u,v\n2,0.5,0.25\n0,0.5,0.25\n2,0,0\n1,1,0\n");
  const std::string found = output({"sample", recipe, "--at", at});
  const auto own = [&](const std::string& in, const char* scheme, const std::string& place) {
    const std::string text =
        output({"sample", in, "-s", scheme, "--at", write("own.csv", "face,u,v\n" + place + "\n")});
    return text.substr(text.find(place) + 2);
  };
  EXPECT_EQ(found.substr(found.find('\n') + 1),
            "2," + own(triangle, "nielson", "0,0.5,0.25") + "0," + own(mesh, "piper", "0,0.5,0.25") + "2," +
                own(triangle, "nielson", "0,0,0") + "1," + own(mesh, "piper", "1,1,0"));
  // Points of a level.
  output({"refine", recipe, "-l", "2"}, "level.obj");
  EXPECT_EQ(read_obj((directory_ / "level.obj").string()).num_faces(), 3 * 16);
}

TEST_F(NormalRecipes, AreDescribed) {
  write("sphere.obj", two_triangles);
  const std::string recipe = write("r.json", R"({"recipes": [)" + recipe_of("piper", R"("mesh": "sphere.obj"}, )") +
                                                 recipe_of("nielson", R"("name": "tip", )" + same_triangle) + "]}");
  expect_parts(expect_done(sublimit({"info", recipe})).out,
               {"recipe 0: piper, 2 patches, faces 0 to 1, 4 points with normals; exact net: no, it is not linear",
                "recipe 1: nielson 'tip', 1 patches, faces 2 to 2, 3 points with normals"});
  const auto info = nlohmann::json::parse(expect_done(sublimit({"info", recipe, "--json"})).out);
  EXPECT_EQ(info["recipes"][1]["faces"], (nlohmann::json{2, 2}));
  // Beside a surface that is linear they are left out, with the reason.
  const std::string both =
      write("b.json", R"({"recipes": [)" + sample_recipe("cone") + ", " + recipe_of("nielson", same_triangle) + "]}");
  expect_parts(expect_done(sublimit({"info", both})).out, {"left out of samples"});
  const Outcome sampled = sublimit({"sample", both, "--grid", "3", "-o", (directory_ / "s.csv").string()});
  EXPECT_EQ(sampled.status, 0);
  expect_parts(sampled.err, {"recipe 1 (nielson) is left out", "not linear", "in a file without them it is sampled"});
  expect_parts(sampled.out, {"9 samples"});
}

TEST_F(NormalRecipes, RefuseWhatDoesNotFit) {
  const std::string out = (directory_ / "s.csv").string();
  const auto refused = [&](const std::string& recipe, int status, std::initializer_list<std::string_view> parts) {
    const std::string in = write("r.json", recipe);
    expect_failure(sublimit({"sample", in, "--grid", "3", "-o", out}), status, parts);
    expect_failure(sublimit({"info", in}), status, parts);
    expect_failure(sublimit({"refine", in, "-l", "1", "-o", (directory_ / "o.obj").string()}), status, parts);
  };
  refused(recipe_of("nielson", R"("mesh": "none.obj"})"), 3, {"r.json: recipe 0 (nielson): mesh: ", "none.obj"});
  write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n");
  refused(recipe_of("nielson", R"("mesh": "quad.obj"})"), 3, {"recipe 0 (nielson): mesh: ", "quad.obj", "4 corners"});
  write("bare.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  refused(recipe_of("piper", R"("mesh": "bare.obj"})"), 3,
          {"recipe 0 (piper): mesh: ", "bare.obj", "no normals", "vn"});
  refused(recipe_of("piper", R"("points": [[0, 0], [1, 0], [0, 1]], "normals": [[0, 0, 1], [1, 0, 0], [0, 0, 1]]})"), 3,
          {"r.json: recipe 0 (piper): ", "edge (0,1)", "along the edge"});
  refused(recipe_of("piper", R"("points": [[0, 0], [1, 0], [0, 1]], "normals": [[0, 0, 1], [0, 0, 0], [0, 0, 1]]})"), 3,
          {"r.json: recipe 0 (piper): vertex 1", "length 0"});
  refused(recipe_of("piper", R"("mesh": "bare.obj", "normals": "guessed"})"), 3, {"normals", "given, estimated"});

  const std::string triangle = write("r.json", recipe_of("nielson", same_triangle));
  const std::string own = write("own.csv", "patch,u,v\n0,0,0\n"), beyond = write("far.csv", "face,u,v\n1,0,0\n");
  expect_failure(sublimit({"sample", triangle, "--at", own, "-o", out}), 3, {"own.csv:1", "face,u,v"});
  expect_failure(sublimit({"sample", triangle, "--at", beyond, "-o", out}), 3, {"far.csv:2", "face 1"});
  expect_failure(sublimit({"sample", triangle, "--curves", "--grid", "2", "-o", out}), 3, {"none of a curve"});
  expect_failure(sublimit({"sample", triangle, "--triangulate", "--grid", "2", "-o", out}), 2, {"--triangulate"});
  const std::string level = (directory_ / "level.obj").string();
  expect_failure(sublimit({"refine", triangle, "-l", "1", "-o", level, "--matrix", (directory_ / "m.mtx").string()}), 2,
                 {"m.mtx", "not linear: there is no matrix"});
  expect_failure(sublimit({"refine", triangle, "-l", "-1", "-o", level}), 2, {"-1"});
  expect_failure(sublimit({"refine", triangle, "-l", "1", "--closed", "-o", level}), 2, {"--closed"});
  expect_failure(sublimit({"bake", triangle, "-l", "1", "-o", (directory_ / "t.safetensors").string()}), 3,
                 {"nielson and piper are not, and have no matrix"});
}

}  // namespace
}  // namespace sublimit::testing
