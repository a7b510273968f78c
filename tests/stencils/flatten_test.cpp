// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "cli_program.h"
#include "meshes/meshes.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/io/detail/usd.h"
#include "sublimit/io/detail/usd_mesh.h"
#include "sublimit/stencils/formats/npy.h"
#include "sublimit/sublimit.h"
#include "support/expect_error.h"
#include "support/gzip_bytes.h"
#include "support/skip.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

std::string layer(const std::string& contents) { return "#usda 1.0\n" + contents; }

const std::string cube_faces =
    "int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]\n"
    "        int[] faceVertexIndices = [0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5]\n";
const std::string cube_points =
    "[(-1, -1, -1), (1, -1, -1), (-1, 1, -1), (1, 1, -1), (-1, -1, 1), (1, -1, 1), (-1, 1, 1), (1, 1, 1)]";

/// A scene as artists' programs write it: a cube of which much is said, beside what is not a mesh.
const std::string scene = layer(
    "(\n    doc = \"a scene\"\n    defaultPrim = \"World\"\n    metersPerUnit = 0.01\n    upAxis = \"Z\"\n)\n\n"
    "# a comment, with a brace {\ndef Xform \"World\"\n{\n    double3 xformOp:translate = (1, 2, 3)\n"
    "    uniform token[] xformOpOrder = [\"xformOp:translate\"]\n\n    def Mesh \"Cube\" (\n        kind = \"component\"\n    )\n    {\n"
    "        float3[] extent = [(-1, -1, -1), (1, 1, 1)] (\n            doc = \"of the cage\"\n        )\n"
    "        point3f[] points = " +
    cube_points + " # control points\n        " + cube_faces +
    "        normal3f[] normals = [(0, 0, 1)] (\n            interpolation = \"constant\"\n        )\n"
    "        int[] creaseIndices = [0, 1, 3]\n        int[] creaseLengths = [3]\n        float[] creaseSharpnesses = [2.5]\n"
    "        point3f[] primvars:same = " +
    cube_points +
    " (\n            interpolation = \"vertex\"\n        )\n"
    "        float[] primvars:height = [0, 1] (\n            interpolation = \"varying\"\n        )\n"
    "        int[] primvars:height:indices = [0, 0, 0, 0, 1, 1, 1, 1]\n"
    "        int[] primvars:face = [0, 1, 2, 3, 4, 5] (\n            interpolation = \"uniform\"\n        )\n"
    "        texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (\n            interpolation = \"faceVarying\"\n        )\n"
    "        int[] primvars:st:indices = [0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3]\n"
    "        color3f[] primvars:displayColor = [(1, 0, 0)]\n        custom string note = \"stays\"\n\n"
    "        def GeomSubset \"Top\" (\n            prepend apiSchemas = [\"MaterialBindingAPI\"]\n        )\n        {\n"
    "            uniform token elementType = \"face\"\n            uniform token familyName = \"materialBind\"\n"
    "            int[] indices = [1]\n            rel material:binding = </World/Paint>\n        }\n    }\n\n"
    "    def Material \"Paint\"\n    {\n        custom float x = 0.10\n    }\n\n"
    "    def Mesh \"Floor\"\n    {\n        uniform token subdivisionScheme = \"none\"\n"
    "        point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n        int[] faceVertexCounts = [3]\n"
    "        int[] faceVertexIndices = [0, 1, 2]\n    }\n}\n");

const std::set<std::string> changed{
    "points",        "extent",        "faceVertexCounts",  "faceVertexIndices", "normals",
    "creaseIndices", "creaseLengths", "creaseSharpnesses", "subdivisionScheme", "indices"};

/// Compares prims but for what becomes other values.
void expect_same_but_for_values(const UsdSpec& before, const UsdSpec& after) {
  EXPECT_EQ(after.type, before.type);
  EXPECT_EQ(after.name, before.name);
  const auto kept = [](const UsdSpec& spec) {
    std::vector<std::string> texts;
    for (const UsdProperty& property : spec.properties) {
      const std::string name(property.name);
      if (!changed.contains(name) && (!name.starts_with("primvars:") || name == "primvars:displayColor"))
        texts.emplace_back(property.text);
    }
    for (const UsdField& field : spec.metadata) texts.emplace_back(field.value);
    return texts;
  };
  EXPECT_EQ(kept(after), kept(before)) << before.name;
  ASSERT_EQ(after.children.size(), before.children.size()) << before.name;
  for (std::size_t i = 0; i < after.children.size(); ++i)
    expect_same_but_for_values(before.children[i], after.children[i]);
}

struct Flattened {
  std::string text;
  FlattenedScene told;
  std::vector<UsdMesh> meshes;
  std::shared_ptr<UsdStage> stage;  // which the meshes are of
};
Flattened flattened(const std::string& text, const FlattenOptions& options = {.relative_chord = 0.01}) {
  const TemporaryDirectory directory;
  Flattened made;
  made.told = flatten(directory.write("scene.usda", text), directory / "flat.usda", options);
  made.text = read_file(directory / "flat.usda");
  made.stage = std::make_shared<UsdStage>(made.text, "flat.usda");
  std::vector<std::string> warnings;
  made.meshes = usd_meshes(*made.stage, warnings);
  return made;
}

const UsdPrimvar& primvar(const UsdMesh& mesh, const std::string& name) {
  const auto found = std::ranges::find(mesh.primvars, name, &UsdPrimvar::name);
  if (found == mesh.primvars.end()) throw std::runtime_error("no primvar " + name);
  return *found;
}

TEST(Flatten, AllButTheMeshStaysByteForByte) {
  const Flattened made = flattened(scene);
  EXPECT_EQ(made.told.warnings, std::vector<std::string>{});
  ASSERT_EQ(made.told.meshes.size(), 1u);
  EXPECT_EQ(made.told.meshes[0].path, "/World/Cube");
  expect_same_but_for_values(parse_usda(scene, "a")->root, parse_usda(made.text, "b")->root);
  const auto head = [](const std::string& text) { return text.substr(0, text.find("    {\n        ")); };
  const auto tail = [](const std::string& text) { return text.substr(text.find("    def Material")); };
  EXPECT_EQ(head(made.text), head(scene));
  EXPECT_EQ(tail(made.text), tail(scene));
  for (const char* const kept : {"doc = \"of the cage\"", " # control points\n", "custom string note = \"stays\""})
    EXPECT_NE(made.text.find(kept), std::string::npos) << kept;
  for (const char* const gone : {"crease", "primvars:height:indices", "constant"})
    EXPECT_EQ(made.text.find(gone), std::string::npos) << gone;
  // A flat scene has nothing to flatten.
  EXPECT_EQ(flattened(made.text).text, made.text);
}

TEST(Flatten, TrianglesAreThoseOfTessellateWithTheirNormals) {
  const Flattened made = flattened(scene);
  Mesh cage = cube();
  cage.face_vertices = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  cage.creases = {{0, 1, 2.5F}, {1, 3, 2.5F}};
  const Mesh expected = tessellate(cage, "catmull-clark", {.chord = 0.01 * std::sqrt(12.0), .normals = true});
  const UsdMesh& cube_mesh = made.meshes[0];
  EXPECT_EQ(cube_mesh.mesh.scheme, "");
  EXPECT_EQ(cube_mesh.mesh.face_vertices, expected.face_vertices);
  EXPECT_EQ(made.told.meshes[0].triangles, expected.num_faces());
  EXPECT_EQ(Eigen::MatrixXf(cube_mesh.mesh.positions.cast<float>()), Eigen::MatrixXf(expected.positions.cast<float>()));
  const UsdSpec* const spec = find_usd_spec(made.stage->root_layer().root, "/World/Cube");
  const UsdProperty* const normals = spec->property("normals");
  const auto numbers = usd_numbers(made.stage->root_layer(), normals->value, "normals", 3);
  const bool per_vertex = normals->text.find("\"vertex\"") != std::string_view::npos;
  ASSERT_EQ(numbers.size(), 3 * (per_vertex ? std::size_t(expected.num_vertices()) : expected.face_vertices.size()));
  for (std::size_t c = 0; c < expected.face_vertices.size(); ++c)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(float(numbers[3 * (per_vertex ? std::size_t(expected.face_vertices[c]) : c) + k]),
                float(expected.normals(expected.face_normals[c], Eigen::Index(k))));
}

// What is the same before is the same after, whatever it is called.
TEST(Flatten, PrimvarsAndSubsetsFollow) {
  const Flattened made = flattened(scene);
  const UsdMesh& mesh = made.meshes[0];
  EXPECT_EQ(Eigen::MatrixXf(primvar(mesh, "same").expanded().cast<float>()),
            Eigen::MatrixXf(mesh.mesh.positions.cast<float>()));
  const UsdPrimvar& height = primvar(mesh, "height");
  EXPECT_EQ(height.interpolation, UsdPrimvar::Interpolation::varying);
  EXPECT_EQ(height.values.minCoeff(), 0);  // linear values reach those of the corners
  EXPECT_EQ(height.values.maxCoeff(), 1);
  const UsdPrimvar& face = primvar(mesh, "face");
  ASSERT_EQ(face.values.rows(), mesh.mesh.num_faces());
  ASSERT_EQ(mesh.subsets.size(), 1u);
  std::vector<Index> of_one;
  for (Index t = 0; t < mesh.mesh.num_faces(); ++t)
    if (face.values(t, 0) == 1) of_one.push_back(t);
  EXPECT_FALSE(of_one.empty());
  EXPECT_EQ(mesh.subsets[0].faces, of_one);
  // The square of every face is the same: linear coordinates of its corners.
  const UsdPrimvar& st = primvar(mesh, "st");
  EXPECT_EQ(st.indices.size(), mesh.mesh.face_vertices.size());
  const double rounding = 1e-15;  // of sums of few products
  EXPECT_NEAR(st.values.minCoeff(), 0, rounding);
  EXPECT_NEAR(st.values.maxCoeff(), 1, rounding);
}

TEST(Flatten, PointsThatMoveMoveOn) {
  std::string moving = scene;
  const std::string still = "point3f[] points = " + cube_points + " # control points\n";
  std::string twice = cube_points;
  for (std::size_t at = 0; (at = twice.find('1', at)) != std::string::npos; ++at) twice[at] = '2';
  moving.replace(moving.find(still), still.size(),
                 "point3f[] points.timeSamples = {\n            0: " + cube_points + ",\n            12.5: " + twice +
                     ",\n        }\n");
  const Flattened made = flattened(moving);
  const UsdMesh& mesh = made.meshes[0];
  ASSERT_EQ(mesh.times, (std::vector<double>{0, 12.5}));
  // Limits of doubled points are doubled, exactly.
  EXPECT_EQ(Eigen::MatrixXf(usd_points(mesh, 1).cast<float>()), Eigen::MatrixXf(2 * usd_points(mesh, 0).cast<float>()));
  const double last_digit = std::numeric_limits<float>::epsilon();  // sums in two orders, rounded to floats near 1
  EXPECT_LE((usd_points(mesh, 0) - flattened(scene).meshes[0].mesh.positions).cwiseAbs().maxCoeff(), last_digit);
  EXPECT_NE(made.text.find("normals.timeSamples = {"), std::string::npos);
}

TEST(Flatten, LeftHandedMeshesGetRightHandedTriangles) {
  std::string left = scene;
  left.insert(left.find("        float3[] extent"), "        uniform token orientation = \"leftHanded\"\n");
  const Flattened made = flattened(left), right = flattened(scene);
  EXPECT_EQ(made.text.find("leftHanded"), std::string::npos);
  const auto normal = [](const UsdMesh& mesh) {
    const auto at = [&](std::size_t k) { return Eigen::Vector3d(mesh.mesh.positions.row(mesh.mesh.face_vertices[k])); };
    return Eigen::Vector3d((at(1) - at(0)).cross(at(2) - at(0))).dot(at(0));
  };
  EXPECT_LT(normal(made.meshes[0]) * normal(right.meshes[0]), 0);
}

TEST(Flatten, MeshesOfOtherLayersAreOverridden) {
  const TemporaryDirectory directory;
  directory.write("asset.usda", scene);
  const std::string text = layer(
      "def \"A\" ( references = @asset.usda@ )\n{\n}\n\ndef Xform \"B\"\n{\n    def \"Inner\" ( references = @asset.usda@ )\n    {\n"
      "        over \"Cube\"\n        {\n            int[] holeIndices = [0]\n        }\n    }\n}\n");
  const FlattenedScene told =
      flatten(directory.write("scene.usda", text), directory / "flat.usda", {.relative_chord = 0.01});
  ASSERT_EQ(told.meshes.size(), 2u);
  EXPECT_LT(told.meshes[1].triangles, told.meshes[0].triangles);  // it has a hole
  EXPECT_EQ(read_file(directory / "asset.usda"), scene);
  UsdStage stage(directory / "flat.usda");
  std::vector<std::string> warnings;
  const auto meshes = usd_meshes(stage, warnings);
  EXPECT_EQ(warnings, std::vector<std::string>{});
  ASSERT_EQ(meshes.size(), 4u);
  for (const UsdMesh& mesh : meshes) EXPECT_EQ(mesh.mesh.scheme, "") << mesh.path;
  EXPECT_EQ(meshes[0].mesh.num_faces(), told.meshes[0].triangles);
  EXPECT_EQ(meshes[2].mesh.num_faces(), told.meshes[1].triangles);
  EXPECT_TRUE(meshes[2].mesh.holes.empty());
  EXPECT_EQ(primvar(meshes[0], "face").values.rows(), meshes[0].mesh.num_faces());
  EXPECT_EQ(meshes[0].mesh.creases.size() + meshes[0].mesh.corners.size(), 0u);
  const Flattened alone = flattened(scene);
  EXPECT_EQ(meshes[0].mesh.positions, alone.meshes[0].mesh.positions);
}

TEST(Flatten, SelectedVariantsAreEditedWhereTheyStand) {
  const std::string text = layer(
      "def \"A\" (\n    variants = {\n        string size = \"big\"\n    }\n)\n{\n    variantSet \"size\" = {\n"
      "        \"big\" {\n            def Mesh \"Cube\"\n            {\n                point3f[] points = " +
      cube_points + "\n                " + cube_faces +
      "            }\n        }\n        \"small\" {\n        }\n    }\n}\n");
  const Flattened made = flattened(text);
  ASSERT_EQ(made.meshes.size(), 1u);
  EXPECT_EQ(made.meshes[0].mesh.scheme, "");
  EXPECT_EQ(made.text.find("over"), std::string::npos);
  EXPECT_EQ(made.meshes[0].mesh.num_faces(), made.told.meshes[0].triangles);
}

TEST(Flatten, PackagesKeepTheirOtherFiles) {
  const TemporaryDirectory directory;
  const std::string image(100, 'i');
  const std::string package = format_usdz({{"main.usda", scene}, {"textures/a.png", image}}, "p");
  const FlattenedScene told =
      flatten(directory.write("scene.usdz", package), directory / "flat.usdz", {.relative_chord = 0.01});
  EXPECT_EQ(told.meshes.size(), 1u);
  const std::string bytes = read_file(directory / "flat.usdz");
  const auto files = usdz_files(bytes, "flat.usdz");
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].name, "main.usda");
  EXPECT_EQ(files[0].bytes, flattened(scene).text);
  EXPECT_EQ(files[1].bytes, image);
  // Without them something is missing, which is told.
  const FlattenedScene alone = flatten(directory / "scene.usdz", directory / "flat.usda", {.relative_chord = 0.01});
  ASSERT_EQ(alone.warnings.size(), 1u);
  EXPECT_NE(alone.warnings[0].find("textures/a.png"), std::string::npos);
}

TEST(Flatten, OtherFormatsGetAllMeshesInTheWorld) {
  const TemporaryDirectory directory;
  (void)flatten(directory.write("scene.usda", scene), directory / "flat.ply", {.relative_chord = 0.01});
  const Mesh all = read_mesh(directory / "flat.ply");
  const Flattened made = flattened(scene);
  ASSERT_EQ(all.num_faces(), made.meshes[0].mesh.num_faces() + 1);
  const Points& local = made.meshes[0].mesh.positions;
  const auto same = [&](Eigen::Index v) {
    return (all.positions.row(v) - local.row(v) - Eigen::RowVector3d(1, 2, 3)).cwiseAbs().maxCoeff() < 1e-6;  // floats
  };
  EXPECT_TRUE(same(0));
  (void)flatten(directory / "scene.usda", directory / "flat.glb", {.relative_chord = 0.01});
  EXPECT_EQ(read_file(directory / "flat.glb").substr(0, 4), "glTF");
}

TEST(Flatten, MeshesWithoutPointsStayAndWarningsOfMeshesAreTold) {
  const std::string empty = layer(
      "def Mesh \"none\"\n{\n    point3f[] points = []\n    int[] faceVertexCounts = []\n"
      "    int[] faceVertexIndices = []\n}\n");
  const Flattened made = flattened(empty);
  EXPECT_EQ(made.text, empty);
  ASSERT_EQ(made.told.meshes.size(), 1u);
  EXPECT_NE(made.told.meshes[0].why_not, "");
  std::string loose = scene;
  loose.replace(loose.find("creaseIndices = [0, 1, 3]"), 25, "creaseIndices = [0, 1, 6]");
  const Flattened told = flattened(loose);
  ASSERT_EQ(told.told.warnings.size(), 1u);
  EXPECT_NE(told.told.warnings[0].find("/World/Cube: creaseIndices"), std::string::npos) << told.told.warnings[0];
}

TEST(CliFlatten, TakesCompressedScenes) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("scene.usda.gz", compressed(scene)).string(),
                    out = (directory / "flat.usda").string();
  expect_done(sublimit({"flatten", path, "--chord", "1%", "-o", out, "--quiet"}));
  EXPECT_EQ(read_file(out), flattened(scene).text);
}

TEST(Flatten, WrongInputIsAnErrorAndLeavesNothing) {
  const TemporaryDirectory directory;
  const auto path = directory.write("scene.usda", scene);
  expect_error<InvalidParameter>([&] { (void)flatten(path, directory / "out.usda", {.chord = -1}); }, {"negative"});
  expect_error<ResourceError>([&] { (void)flatten(path, directory / "out.usda", {.max_triangles = 10}); },
                              {"triangles"});
  expect_error<IoError>([&] { (void)flatten(directory / "none.usda", directory / "out.usda"); }, {"none.usda"});
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(CliFlatten, TellsWhatItDoesAndLeavesMeshesOfSkeletons) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("scene.usda", scene).string(), out = (directory / "flat.usda").string();
  const Outcome done = sublimit({"flatten", in, "-o", out});
  EXPECT_EQ(done.status, 0);
  EXPECT_EQ(done.err, "");
  EXPECT_NE(done.out.find("flat.usda: 1 of 1 meshes with a scheme are "), std::string::npos) << done.out;
  std::string bound = scene;
  bound.insert(
      bound.find("        custom string note"),
      "        int[] primvars:skel:jointIndices = [0, 0, 0, 0, 0, 0, 0, 0] (\n            interpolation = \"vertex\"\n        )\n");
  const Outcome left = sublimit({"flatten", directory.write("bound.usda", bound).string(), "-o", out});
  EXPECT_EQ(left.status, 1);
  EXPECT_NE(left.err.find("/World/Cube: left as it is: it is bound to a skeleton"), std::string::npos) << left.err;
  EXPECT_EQ(read_file(out), bound);
  std::string quads_of_loop = scene;
  quads_of_loop.insert(quads_of_loop.find("        float3[] extent"),
                       "        uniform token subdivisionScheme = \"loop\"\n");
  const Outcome refused = sublimit({"flatten", directory.write("loop.usda", quads_of_loop).string(), "-o", out});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("/World/Cube: left as it is: "), std::string::npos) << refused.err;
  EXPECT_EQ(read_file(out), quads_of_loop);
  const Outcome other = sublimit({"flatten", directory.write("a.obj", "v 0 0 0\n").string(), "-o", out});
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find(".usda, .usd or .usdz"), std::string::npos) << other.err;
}

TEST(CliApply, TakesScenesThatMoveAsFrames) {
  const TemporaryDirectory directory;
  std::string moving = scene;
  const std::string still = "double3 xformOp:translate = (1, 2, 3)";
  moving.replace(moving.find(still), still.size(),
                 "double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 10: (1, 0, 0), 20: (4, 0, 0) }");
  const std::string cage = directory.write("scene.usda", moving).string(),
                    table = (directory / "t.safetensors").string(), out = (directory / "out.npy").string();
  expect_done(sublimit({"bake", cage, "-s", "catmull-clark", "-l", "1", "-o", table, "--quiet"}));
  expect_done(sublimit({"apply", table, cage, "-o", out, "--quiet"}));
  const NpyArray frames(out);
  ASSERT_EQ(frames.shape().size(), 3u);
  EXPECT_EQ(frames.shape()[0], 3);
}

/// What two other readers make of a scene (tests/npm/usd.mjs).
nlohmann::json others_read(const std::filesystem::path& path) {
  const std::string script = SUBLIMIT_SOURCE "/tests/npm/usd.mjs", out = path.string() + ".json";
  if (std::system(("node '" + script + "' '" + path.string() + "' > '" + out + "' 2> '" + out + ".err'").c_str()) != 0)
    throw std::runtime_error(read_file(out + ".err").substr(0, 2000));
  return nlohmann::json::parse(read_file(out));
}

bool has_npm_packages() {
  return std::system("command -v node > /dev/null && test -d '" SUBLIMIT_SOURCE "/tests/npm/node_modules/tinyusdz'") ==
         0;
}

/// Corners of triangles as one list.
std::vector<float> at_corners(const Mesh& mesh, const Points& rows, const std::vector<Index>& indices) {
  std::vector<float> all;
  for (std::size_t c = 0; c < mesh.face_vertices.size(); ++c)
    for (Eigen::Index k = 0; k < rows.cols(); ++k) all.push_back(float(rows(indices[c], k)));
  return all;
}

TEST(Flatten, OtherReadersHaveTheSameNumbers) {
  SUBLIMIT_NEEDS_PROGRAM(has_npm_packages(), "node, and the packages of tests/npm");
  const TemporaryDirectory directory;
  const auto in = directory.write("scene.usda", scene);
  for (const char* const name : {"flat.usda", "flat.usdz"}) {
    SCOPED_TRACE(name);
    (void)flatten(in, directory / name, {.relative_chord = 0.01});
    UsdStage stage(directory / name);
    std::vector<std::string> warnings;
    const UsdMesh mesh = usd_meshes(stage, warnings)[0];
    const std::vector<float> positions = at_corners(mesh.mesh, mesh.mesh.positions, mesh.mesh.face_vertices);
    const UsdPrimvar& st = primvar(mesh, "st");
    const std::vector<float> texture = at_corners(mesh.mesh, st.values, st.indices);
    const nlohmann::json read = others_read(directory / name);
    std::size_t readers = 0;
    for (const auto& [reader, meshes] : read.items()) {
      SCOPED_TRACE(reader);
      const auto found = std::ranges::find_if(
          meshes, [](const nlohmann::json& one) { return one["name"].get<std::string>().ends_with("Cube"); });
      ASSERT_NE(found, meshes.end());
      // A reader may order triangles by their materials.
      const auto sorted = [](const std::vector<float>& corners, std::size_t width) {
        std::vector<std::vector<float>> triangles;
        for (std::size_t i = 0; i + 3 * width <= corners.size(); i += 3 * width)
          triangles.emplace_back(corners.begin() + std::ptrdiff_t(i), corners.begin() + std::ptrdiff_t(i + 3 * width));
        std::ranges::sort(triangles);
        return triangles;
      };
      EXPECT_EQ(sorted((*found)["positions"].get<std::vector<float>>(), 3), sorted(positions, 3));
      const auto read_texture = (*found)["texture"].get<std::vector<float>>();
      if (reader == "three" || !read_texture.empty()) {
        EXPECT_EQ(sorted(read_texture, 2), sorted(texture, 2));
      }
      const auto normals = (*found)["normals"].get<std::vector<float>>();
      ASSERT_EQ(normals.size(), positions.size());
      ++readers;
    }
    EXPECT_EQ(readers, 2u);
  }
}

}  // namespace
}  // namespace sublimit::testing
