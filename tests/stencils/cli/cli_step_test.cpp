// SPDX-License-Identifier: Apache-2.0
// `sublimit step`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <tuple>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/write_mesh.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

std::string write(const TemporaryDirectory& directory, const Mesh& mesh) {
  write_obj(directory / "m.obj", mesh);
  return (directory / "m.obj").string();
}

TEST(CliStep, WritesClosedMeshesAsValidSolids) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "o.step").string(), report = (directory / "r.json").string();
  for (const auto& [scheme, mesh] : std::vector<std::pair<std::string, Mesh>>{
           {"catmull-clark", cube()}, {"doo-sabin", cube()}, {"loop", icosahedron()}, {"bilinear", cube()}}) {
    expect_done(sublimit(
        {"step", write(directory, mesh), "-s", scheme, "--tolerance", "0.01%", "-o", out, "--report", report}));
    const nlohmann::json json = nlohmann::json::parse(read_file(report));
    EXPECT_EQ(json["valid"], true) << scheme;
    EXPECT_EQ(json["solids"], 1) << scheme;
    EXPECT_EQ(json["shells"], 0) << scheme;
    // Caps alone are off, and by the deviation at most.
    EXPECT_NEAR(json["volume"]["file"], double(json["volume"]["limit"]),
                double(json["deviation"]) * double(json["area"]["limit"]) + cad_exact)
        << scheme;
    const std::string text = read_file(out);
    EXPECT_TRUE(text.starts_with("ISO-10303-21;")) << scheme;
    EXPECT_NE(text.find("MANIFOLD_SOLID_BREP"), std::string::npos) << scheme;
  }
}

TEST(CliStep, WritesOpenMeshesAsShellsAndBrepToo) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "o.brep").string(), report = (directory / "r.json").string();
  expect_done(sublimit(
      {"step", write(directory, grid(5, 4)), "-s", "catmull-clark", "-o", out, "--report", report, "--quiet"}));
  const nlohmann::json json = nlohmann::json::parse(read_file(report));
  EXPECT_EQ(json["valid"], true);
  EXPECT_EQ(json["solids"], 0);
  EXPECT_EQ(json["shells"], 1);
  EXPECT_EQ(json["volume"], nullptr);
  EXPECT_NE(read_file(out).find("CASCADE Topology"), std::string::npos);
}

// Half of a grid is a group, and its triangles have its name too; all of it is an object.
TEST(CliStep, NamesOfGroupsAndObjectsAreThoseOfFaces) {
  const TemporaryDirectory directory;
  std::istringstream lines(format_obj(grid(4, 2)));
  std::string text = "o sheet\n";
  int faces = 0;
  for (std::string line; std::getline(lines, line); text += line + "\n")
    if (line.starts_with("f ") && ++faces == 5) text += "g upper half\n";
  const std::string mesh = directory.write("m.obj", text), out = (directory / "o.step").string(),
                    report = (directory / "r.json").string();
  for (const std::vector<std::string>& scheme :
       std::vector<std::vector<std::string>>{{"catmull-clark"}, {"bilinear"}, {"loop", "--triangulate"}}) {
    std::vector<std::string> arguments{"step", mesh, "-o", out, "--report", report, "--no-packing", "-s"};
    arguments.insert(arguments.end(), scheme.begin(), scheme.end());
    expect_done(sublimit(arguments));
    const std::string file = read_file(out);
    std::ptrdiff_t upper = 0, lower = 0;
    for (size_t at = 0; (at = file.find("ADVANCED_FACE('", at)) != std::string::npos; ++at) {
      const std::string_view face = std::string_view(file).substr(at + 15, 12);
      upper += face.starts_with("upper half'");
      lower += face.starts_with("sheet'");
    }
    const nlohmann::json json = nlohmann::json::parse(read_file(report));
    EXPECT_EQ(upper + lower, json["faces"]) << scheme[0];
    EXPECT_EQ(upper, lower) << scheme[0];
  }
}

// Faces of a grid are red on the left and blue on the right, and of two materials.
TEST(CliStep, ColoursAndMaterialsAreThoseOfFaces) {
  const TemporaryDirectory directory;
  const std::string in = (directory / "m.ply").string(), out = (directory / "o.step").string(),
                    obj = (directory / "m.obj").string();
  Mesh mesh = grid(4, 2);
  const auto count = [](const std::string& text, const std::string& word) {
    int found = 0;
    for (size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  const auto faces_of = [&](const std::string& input) {
    expect_done(sublimit({"step", input, "-s", "catmull-clark", "-o", out}));
    return count(read_file(out), "ADVANCED_FACE(");
  };
  write_mesh(in, mesh);
  const int plain_faces = faces_of(in);
  EXPECT_EQ(count(read_file(out), "COLOUR"), 0);
  for (const auto& [name, left, right] : {std::tuple{"red", 1.0, 0.0}, {"green", 0.0, 0.0}, {"blue", 0.0, 0.5}}) {
    Mesh::Values& channel = mesh.face_values.emplace_back();
    channel.name = name;
    for (Index f = 0; f < mesh.num_faces(); ++f) channel.values.push_back(f % 4 < 2 ? left : right);
  }
  write_mesh(in, mesh);
  EXPECT_GT(faces_of(in), plain_faces);
  const std::string text = read_file(out);
  EXPECT_EQ(count(text, "STYLED_ITEM("), count(text, "ADVANCED_FACE("));
  EXPECT_NE(text.find("DRAUGHTING_PRE_DEFINED_COLOUR('red')"), std::string::npos);
  EXPECT_NE(text.find("COLOUR_RGB('',0."), std::string::npos);

  // None that STEP could not have.
  mesh.face_values[2].values[0] = 1.5;
  write_mesh(in, mesh);
  const Outcome told = sublimit({"step", in, "-s", "catmull-clark", "-o", out});
  EXPECT_EQ(told.status, 0);
  EXPECT_NE(told.err.find("colours of faces are left out: 'blue' of face 0 is not within 0 to 1"), std::string::npos);
  EXPECT_EQ(count(read_file(out), "COLOUR"), 0);

  mesh.face_values.clear();
  mesh.materials.names = {"steel", "glass"};
  for (Index f = 0; f < mesh.num_faces(); ++f) mesh.materials.of_face.push_back(f % 4 < 2 ? 0 : 1);
  write_mesh(obj, mesh);
  faces_of(obj);
  EXPECT_GT(count(read_file(out), "ADVANCED_FACE('steel'"), 0);
  EXPECT_GT(count(read_file(out), "ADVANCED_FACE('glass'"), 0);
}

TEST(CliStep, SameInputSameBytes) {
  const TemporaryDirectory directory;
  const std::string mesh = write(directory, cube()), one = (directory / "a.step").string();
  expect_done(sublimit({"step", mesh, "-s", "catmull-clark", "-o", one, "--quiet"}));
  const std::string first = read_file(one);
  expect_done(sublimit({"step", mesh, "-s", "catmull-clark", "-o", one, "--quiet", "--threads", "1"}));
  EXPECT_EQ(read_file(one), first);
}

// Numbers are those of the mesh in any unit, which the file names.
TEST(CliStep, FilesNameTheirUnit) {
  const TemporaryDirectory directory;
  const std::string mesh = write(directory, cube()), out = (directory / "o.step").string();
  const auto points = [&](const std::vector<std::string>& unit, const std::string& says) {
    std::vector<std::string> words{"step", mesh, "-s", "bilinear", "-o", out};
    words.insert(words.end(), unit.begin(), unit.end());
    const Outcome outcome = sublimit(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("lengths are in " + says), std::string::npos) << outcome.out;
    const std::string file = read_file(out);
    std::multiset<std::string> points;
    for (size_t at = 0; (at = file.find("CARTESIAN_POINT('',(", at)) != std::string::npos; ++at)
      points.insert(file.substr(at, file.find(')', at + 19) - at));
    return std::pair(points, file);
  };
  const auto [plain, in_mm] = points({}, "mm; --unit");
  EXPECT_GT(plain.size(), 8u);
  EXPECT_NE(in_mm.find("SI_UNIT(.MILLI.,.METRE.)"), std::string::npos);
  EXPECT_EQ(points({"--unit", "mm"}, "mm\n").second, in_mm);
  const auto [metres, in_m] = points({"--unit", "m"}, "m\n");
  EXPECT_EQ(metres, plain);
  EXPECT_NE(in_m.find("SI_UNIT($,.METRE.)"), std::string::npos);
  const auto [inches, in_inches] = points({"--unit", "inch"}, "inch\n");
  EXPECT_EQ(inches, plain);
  EXPECT_NE(in_inches.find("CONVERSION_BASED_UNIT('INCH'"), std::string::npos);
  EXPECT_EQ(points({}, "mm").second, in_mm);  // no unit is left behind
  expect_failure(sublimit({"step", mesh, "-s", "bilinear", "--unit", "ell", "-o", out}), 2, {"--unit"});
  expect_failure(sublimit({"step", mesh, "-s", "bilinear", "--unit", "m", "-o", (directory / "o.brep").string()}), 2,
                 {"only STEP files have a unit"});
}

TEST(CliStep, LeavesNoFileAfterErrors) {
  const TemporaryDirectory directory;
  const std::string mesh = write(directory, icosahedron()), out = (directory / "o.step").string();
  EXPECT_EQ(sublimit({"step", mesh, "-s", "loop", "--tolerance", "-1", "-o", out}).status, 2);
  EXPECT_EQ(sublimit({"step", mesh, "-s", "butterfly", "-o", out}).status, 3);
  EXPECT_EQ(sublimit({"step", mesh, "-s", "loop", "--join", "g7", "-o", out}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace sublimit::testing
