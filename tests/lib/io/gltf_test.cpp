// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/gltf.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <filesystem>
#include <limits>

#include "meshes/meshes.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/base64.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/mesh/topology.h"
#include "support/expect_error.h"
#include "support/gltf_parts.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

using Ids = std::vector<Index>;
using Words = std::vector<std::string>;

const std::vector<float> square_positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

/// A mesh of one primitive on a node.
std::string one_mesh(const std::string& attributes, const std::string& more) {
  return R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{)" +
         attributes + "}" + more + "}]}]";
}
std::string square_with(const std::string& nodes) {
  GltfParts parts;
  parts.positions(square_positions);
  parts.indices({0, 1, 2, 0, 2, 3});
  return parts.glb(R"("meshes":[{"name":"plate","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)" + nodes);
}

TEST(Gltf, TrianglesWithAndWithoutIndicesAreRead) {
  GltfParts parts;
  parts.positions(square_positions);
  parts.indices({0, 1, 2, 0, 2, 3});
  const Mesh mesh = parse_gltf(parts.glb(one_mesh("\"POSITION\":0", ",\"indices\":1")), "a.glb");
  EXPECT_EQ(mesh.positions, (Points(4, 3) << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0).finished());
  EXPECT_EQ(mesh.face_sizes, (Ids{3, 3}));
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 0, 2, 3}));
  EXPECT_TRUE(mesh.warnings.empty() && mesh.notes.empty());
  EXPECT_TRUE(mesh.objects.names.empty() && mesh.objects.of_face.empty());
  GltfParts soup;  // corners by themselves
  soup.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, -0.0f, 0, 0, 1, 1, 0, 0, 1, 0});
  const Mesh welded = parse_gltf(soup.glb(one_mesh("\"POSITION\":0", "")), "a.glb");
  EXPECT_EQ(welded.positions, mesh.positions);
  EXPECT_EQ(welded.face_vertices, mesh.face_vertices);
  EXPECT_EQ(welded.notes, (Words{"a.glb: welded 6 vertices of the file to 4"}));
}

// The triangles of a strip are (0, 1, 2), (1, 3, 2), (2, 3, 4); of a fan (1, 2, 0), (2, 3, 0).
TEST(Gltf, StripsAndFansAreCut) {
  GltfParts parts;
  parts.positions({0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0});
  const Mesh strip = parse_gltf(parts.glb(one_mesh("\"POSITION\":0", ",\"mode\":5")), "a.glb");
  EXPECT_EQ(strip.face_vertices, (Ids{0, 1, 2, 1, 3, 2, 2, 3, 4}));
  GltfParts square;
  square.positions(square_positions);
  const Mesh fan = parse_gltf(square.glb(one_mesh("\"POSITION\":0", ",\"mode\":6")), "a.glb");
  EXPECT_EQ(fan.face_vertices, (Ids{1, 2, 0, 2, 3, 0}));
  // Corners that are repeated lead a strip to another place.
  parts.add<std::uint8_t>(5121, "SCALAR", 1, {0, 1, 2, 2, 3, 3, 4, 2});
  const Mesh jump = parse_gltf(parts.glb(one_mesh("\"POSITION\":0", ",\"mode\":5,\"indices\":1")), "a.glb");
  EXPECT_EQ(jump.face_vertices, (Ids{0, 1, 2, 3, 2, 4}));
  EXPECT_TRUE(jump.warnings.empty());
}

// Numbers of each type, normalized or not, with rows apart from each other.
TEST(Gltf, AccessorsOfAllTypesAreRead) {
  const auto expect = [](GltfParts parts, double unit) {
    const Mesh mesh = parse_gltf(parts.glb(one_mesh("\"POSITION\":0", "")), "a.glb");
    EXPECT_EQ(mesh.positions, (Points(3, 3) << 0, 0, 0, unit, 0, 0, 0, unit, -unit).finished());
  };
  for (const bool normalized : {false, true}) {
    const std::string more = normalized ? ",\"normalized\":true" : "";
    GltfParts int8, int16;
    int8.add<std::int8_t>(5120, "VEC3", 3, {0, 0, 0, 127, 0, 0, 0, 127, -127}, more);
    expect(int8, normalized ? 1 : 127);
    int16.add<std::int16_t>(5122, "VEC3", 3, {0, 0, 0, 32767, 0, 0, 0, 32767, -32767}, more);
    expect(int16, normalized ? 1 : 32767);
    const auto unsigned_ones = [&](auto number, int type) {
      using T = decltype(number);
      GltfParts parts;
      parts.add<T>(type, "VEC3", 3, {0, 0, 0, number, 0, 0, 0, number, 0}, more);
      const Mesh mesh = parse_gltf(parts.glb(one_mesh("\"POSITION\":0", "")), "a.glb");
      EXPECT_EQ(mesh.positions(1, 0), normalized ? 1 : double(number));
    };
    unsigned_ones(std::uint8_t{255}, 5121);
    unsigned_ones(std::uint16_t{65535}, 5123);
    unsigned_ones(std::uint32_t{4294967295}, 5125);
  }
  GltfParts least;  // -128 is -1 too
  least.add<std::int8_t>(5120, "VEC3", 3, {0, 0, 0, 127, 0, 0, 0, -128, 0}, ",\"normalized\":true");
  EXPECT_EQ(parse_gltf(least.glb(one_mesh("\"POSITION\":0", "")), "a.glb").positions(2, 1), -1);

  GltfParts apart;
  const std::string rows = bytes_of<float>({9, 0, 0, 0, 9, 9, 1, 0, 0, 9, 9, 0, 1, 0, 9});
  const int view = apart.add_view(rows, ",\"byteStride\":20");
  apart.add_accessor(R"({"bufferView":)" + std::to_string(view) +
                     R"(,"byteOffset":4,"componentType":5126,"count":3,"type":"VEC3"})");
  const Mesh mesh = parse_gltf(apart.glb(one_mesh("\"POSITION\":0", "")), "a.glb");
  EXPECT_EQ(mesh.positions, (Points(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished());
}

TEST(Gltf, SparseRowsReplaceOthersOrZeros) {
  for (const bool has_base : {true, false}) {
    GltfParts parts;
    const int base = parts.add_view(bytes_of<float>({5, 5, 5, 1, 0, 0, 5, 5, 5}));
    const int rows = parts.add_view(bytes_of<std::uint8_t>({0, 2}));
    const int values = parts.add_view(bytes_of<float>({0, 0, 1, 0, 1, 0}));
    const std::string sparse = R"(,"sparse":{"count":2,"indices":{"bufferView":)" + std::to_string(rows) +
                               R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) + "}}";
    parts.add_accessor((has_base ? "{\"bufferView\":" + std::to_string(base) + "," : "{") +
                       R"("componentType":5126,"count":3,"type":"VEC3")" + sparse + "}");
    const Mesh mesh = parse_gltf(parts.glb(one_mesh("\"POSITION\":0", "")), "a.glb");
    EXPECT_EQ(mesh.positions, (Points(3, 3) << 0, 0, 1, has_base ? 1 : 0, 0, 0, 0, 1, 0).finished());
  }
}

// A quarter turn about z, then a move: (x, y, z) -> (2 - y, x, z), both ways of writing it.
TEST(Gltf, NodesMoveTheirMeshes) {
  const Points moved = (Points(4, 3) << 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 0, 0).finished();
  const std::string matrix = R"("nodes":[{"mesh":0,"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,2,0,0,1]}])";
  const double half = std::sqrt(0.5);
  const std::string trs =
      R"("nodes":[{"children":[1],"translation":[2,0,0]},{"name":"turned","mesh":0,"rotation":[0,0,)" +
      std::to_string(half) + "," + std::to_string(half) + "]}]";
  EXPECT_EQ(parse_gltf(square_with(matrix), "a.glb").positions, moved);
  const Mesh mesh = parse_gltf(square_with(trs), "a.glb");
  const double few_roundings = 4 * std::numeric_limits<double>::epsilon();  // of a quaternion that is normalized
  EXPECT_LE((mesh.positions - moved).cwiseAbs().maxCoeff(), few_roundings);
  EXPECT_EQ(mesh.objects.names, Words{"turned"});
  EXPECT_EQ(mesh.objects.of_face, (Ids{0, 0}));
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 0, 2, 3}));
  // A mirror image has its faces turned.
  const Mesh tiny = parse_gltf(square_with(R"("nodes":[{"mesh":0,"scale":[-1e-200,1e-200,1e-200]}])"), "a.glb");
  EXPECT_EQ(tiny.face_vertices, (Ids{0, 2, 1, 0, 3, 2}));
  const Mesh mirrored = parse_gltf(square_with(R"("nodes":[{"mesh":0,"scale":[-1,1,1]}])"), "a.glb");
  EXPECT_EQ(mirrored.positions.row(1), Eigen::RowVector3d(-1, 0, 0));
  EXPECT_EQ(mirrored.face_vertices, (Ids{0, 2, 1, 0, 3, 2}));
  EXPECT_EQ(mirrored.objects.names, Words{"plate"});
}

TEST(Gltf, MeshesStandWhereNodesPutThem) {
  const Mesh mesh = parse_gltf(
      square_with(
          R"("scene":1,"scenes":[{"nodes":[3]},{"nodes":[0,2]}],"nodes":[{"name":"first","mesh":0,"children":[1]},)"
          R"({"mesh":0,"translation":[0,0,5]},{"name":"first","mesh":0,"translation":[0,0,9]},{"name":"x","mesh":0}])"),
      "a.glb");
  EXPECT_EQ(mesh.num_vertices(), 12);
  EXPECT_EQ(mesh.objects.names, (Words{"first", "plate"}));
  EXPECT_EQ(mesh.objects.of_face, (Ids{0, 0, 1, 1, 0, 0}));
  EXPECT_EQ(mesh.positions(4, 2), 5);
  EXPECT_EQ(mesh.positions(8, 2), 9);
  EXPECT_EQ(mesh.notes,
            (Words{"a.glb: 1 nodes with meshes are in other scenes and left out; the first is nodes[3] 'x'"}));
  EXPECT_EQ(parse_gltf(square_with(R"("nodes":[{"children":[1]},{"mesh":0},{"mesh":0}])"), "a.glb").num_vertices(), 8);
  EXPECT_EQ(parse_gltf(square_with(R"("scenes":[])"), "a.glb").num_vertices(), 4) << "neither scenes nor nodes";
}

TEST(Gltf, PrimitivesOfAMeshShareItsVerticesAndHaveMaterials) {
  GltfParts parts;
  parts.positions(square_positions);
  parts.indices({0, 1, 2});
  parts.indices({0, 2, 3});
  parts.positions({0, 0, 0, 0, 1, 0, 0, 0, 1});  // another accessor, two of its vertices at known places
  const std::string rest =
      R"("nodes":[{"mesh":0}],"materials":[{"name":"red"},{},{"name":"a#b #\u0007\\","emissiveFactor":[1,0,0]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":2},)"
      R"({"attributes":{"POSITION":0},"indices":2},{"attributes":{"POSITION":3},"material":1}]}])";
  const Mesh mesh = parse_gltf(parts.glb(rest), "a.glb");
  EXPECT_EQ(mesh.num_vertices(), 5);
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 0, 2, 3, 0, 3, 4}));
  EXPECT_EQ(mesh.materials.names, (Words{"a#b ___", "material_1"}));
  EXPECT_EQ(mesh.materials.of_face, (Ids{0, -1, 1}));
  EXPECT_EQ(mesh.notes, (Words{"a.glb: welded 7 vertices of the file to 5",
                               "a.glb: of materials the names are kept, not their colours and textures",
                               "a.glb: line ends, # behind blanks and a last \\ in names are replaced by _"}));
}

// A seam: the vertices 0 and 2 of the square have two texture coordinates. t is counted from the lower edge.
TEST(Gltf, TextureCoordinatesAreThoseOfCorners) {
  GltfParts parts;
  parts.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
  parts.add<float>(5126, "VEC2", 2, {0, 1, 0.5, 1, 0.5, 0, 0.75, 1, 1, 0, 0.75, 0});
  const Mesh mesh = parse_gltf(parts.glb(one_mesh("\"POSITION\":0,\"TEXCOORD_0\":1", "")), "a.glb");
  ASSERT_EQ(mesh.face_varying.size(), 1u);
  const Mesh::FaceVarying& uv = mesh.face_varying[0];
  EXPECT_EQ(uv.name, "uv");
  EXPECT_EQ(uv.values, (Points(6, 2) << 0, 0, 0.5, 0, 0.5, 1, 0.75, 0, 1, 1, 0.75, 1).finished());
  EXPECT_EQ(uv.indices, (Ids{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 0, 2, 3}));
  // Corners of one vertex with equal values share them, and there is no seam.
  GltfParts whole;
  whole.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
  whole.add<std::uint8_t>(5121, "VEC2", 2, {0, 255, 255, 255, 255, 0, 0, 255, 255, 0, 0, 0}, ",\"normalized\":true");
  EXPECT_EQ(parse_gltf(whole.glb(one_mesh("\"POSITION\":0,\"TEXCOORD_0\":1", "")), "a.glb").face_varying[0].indices,
            (Ids{0, 1, 2, 0, 2, 3}));
}

TEST(Gltf, ColoursAndNumbersAreValuesOfVertices) {
  GltfParts parts;
  parts.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  parts.add<std::uint8_t>(5121, "VEC4", 4, {255, 0, 1, 255, 2, 3, 4, 5, 6, 7, 8, 9}, ",\"normalized\":true");
  parts.add<float>(5126, "SCALAR", 1, {0.1f, -2, 3});
  const int view = parts.add_view(bytes_of<std::int16_t>({-5, 0, 6, 0, 7, 0}), ",\"byteStride\":4");
  parts.add_accessor("{\"bufferView\":" + std::to_string(view) + R"(,"componentType":5122,"count":3,"type":"SCALAR"})");
  parts.add<float>(5126, "VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
  const Mesh mesh = parse_gltf(
      parts.glb(one_mesh("\"POSITION\":0,\"NORMAL\":4,\"COLOR_0\":1,\"_heat\":2,\"_PART\":3,\"_FLOW\":4", "")),
      "a.glb");
  ASSERT_EQ(mesh.vertex_values.size(), 6u);
  const auto expect = [&](size_t i, const std::string& name, ValueType type, const std::vector<double>& values) {
    EXPECT_EQ(mesh.vertex_values[i].name, name);
    EXPECT_EQ(mesh.vertex_values[i].type, type);
    EXPECT_EQ(mesh.vertex_values[i].values, values);
  };
  expect(0, "red", ValueType::uint8, {255, 2, 6});
  expect(1, "green", ValueType::uint8, {0, 3, 7});
  expect(2, "blue", ValueType::uint8, {1, 4, 8});
  expect(3, "alpha", ValueType::uint8, {255, 5, 9});
  expect(4, "PART", ValueType::int16, {-5, 6, 7});
  expect(5, "heat", ValueType::float32, {double(0.1f), -2, 3});
  EXPECT_EQ(mesh.warnings, (Words{"a.glb: meshes[0]: '_FLOW' is left out: it has 3 numbers at each vertex, not one"}));
}

// What copies of a vertex do not agree on, and what some vertices lack, is left out and told.
TEST(Gltf, ValuesThatAreNotOneForEachVertexAreLeftOut) {
  GltfParts parts;
  parts.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
  parts.add<float>(5126, "SCALAR", 1, {1, 2, 3, 1, 3, 4});
  parts.add<float>(5126, "SCALAR", 1, {1, 2, 3, 1, 5, 4});
  parts.add<float>(5126, "VEC3", 3, std::vector<float>(18, 0.5f));
  parts.positions({0, 0, 0, 0, 1, 0, 0, 0, 1});
  const Mesh mesh = parse_gltf(parts.glb(R"("meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0,"_A":1,)"
                                         R"("_B":2,"COLOR_0":3}},{"attributes":{"POSITION":4}}]}])"),
                               "a.glb");
  ASSERT_EQ(mesh.vertex_values.size(), 3u);
  EXPECT_EQ(mesh.vertex_values[0].values, (std::vector<double>{0.5, 0.5, 0.5, 0.5, 1}));
  EXPECT_EQ(mesh.warnings, (Words{"a.glb: meshes[0] 'm': some vertices have no colour; they are white",
                                  "a.glb: meshes[0] 'm': '_A' is at some of the vertices alone and is left out",
                                  "a.glb: meshes[0] 'm': '_B' differs between the faces of a vertex and is left out"}));
  const Mesh one = parse_gltf(parts.glb(one_mesh("\"POSITION\":0,\"_A\":1", "")), "a.glb");
  EXPECT_EQ(one.vertex_values.at(0).values, (std::vector<double>{1, 2, 3, 4}));
}

TEST(Gltf, TrianglesOfNothingAreLeftOutWithTheirVertices) {
  GltfParts parts;
  parts.positions({9, 9, 9, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 7, 7, 7});
  parts.add<float>(5126, "SCALAR", 1, {0, 1, 2, 3, 1, 5});
  parts.indices({0, 5, 0, 1, 2, 4, 1, 2, 3});
  const Mesh mesh = parse_gltf(parts.glb(one_mesh("\"POSITION\":0,\"_A\":1", ",\"indices\":2")), "a.glb");
  EXPECT_EQ(mesh.positions, (Points(3, 3) << 0, 0, 0, 1, 0, 0, 1, 1, 0).finished());
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2}));
  EXPECT_EQ(mesh.vertex_values.at(0).values, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(mesh.warnings, (Words{"a.glb: meshes[0].primitives[0]: a triangle with two equal corners, which is left "
                                  "out; so 2 times in the file"}));
}

// Quadrilaterals and a pentagon that were cut into fans: the first corner tells where the next one begins.
TEST(Gltf, PolygonsThatWereCutAreFacesAgain) {
  GltfParts parts;
  parts.positions({0, 0, 0, 1, 0, 0, 2, 1, 0, 1, 2, 0, 0, 1, 0, 2, 0, 0, 3, 0, 0});
  parts.indices({0, 1, 2, 0, 2, 3, 0, 3, 4, 5, 2, 1, 6, 2, 5});
  const Mesh mesh = parse_gltf(
      parts.glb(one_mesh("\"POSITION\":0", R"(,"indices":1,"extensions":{"FB_ngon_encoding":{}})")), "a.glb");
  EXPECT_EQ(mesh.face_sizes, (Ids{5, 3, 3}));
  EXPECT_EQ(mesh.face_vertices, (Ids{0, 1, 2, 3, 4, 5, 2, 1, 6, 2, 5}));
  EXPECT_EQ(parse_gltf(parts.glb(one_mesh("\"POSITION\":0", ",\"indices\":1")), "a.glb").num_faces(), 5);
}

TEST(Gltf, WhatIsNotReadIsTold) {
  GltfParts parts;
  parts.positions(square_positions);
  parts.indices({0, 1, 2, 0, 2});
  const Mesh mesh = parse_gltf(
      parts.glb(R"("nodes":[{"name":"arm","mesh":0,"skin":0,"scale":[2,2,2]},{"mesh":1,"translation":[5,0,0]}],)"
                R"("animations":[{},{}],"skins":[{}],"meshes":[{"name":"m","primitives":[)"
                R"({"attributes":{"POSITION":0},"indices":1,"targets":[{"POSITION":0}]},)"
                R"({"attributes":{"POSITION":0},"mode":1},{"attributes":{"POSITION":0},"mode":0},{"attributes":{}}]},)"
                R"({"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_1":0,"COLOR_2":0}}]}])"),
      "a.glb");
  EXPECT_EQ(mesh.positions(1, 0), 1) << "a skin, not the node, puts vertices where they are";
  EXPECT_EQ(
      mesh.warnings,
      (Words{"a.glb: nodes[0] 'arm': its skin is left out; its vertices are where they were bound to joints",
             "a.glb: meshes[0] 'm': points or lines, which are left out; so 2 times in the file",
             "a.glb: meshes[0] 'm': a primitive without POSITION, which is left out",
             "a.glb: meshes[0] 'm': its morph targets are left out",
             "a.glb: meshes[0].primitives[0]: corners behind the last triangle are left out; so 2 times in the file",
             "a.glb: meshes[1]: 'COLOR_2' is left out", "a.glb: meshes[1]: 'TEXCOORD_1' is left out",
             "a.glb: 2: animations are left out"}));
}

TEST(Gltf, BuffersAreInTheFileOrBesideIt) {
  const TemporaryDirectory directory;
  GltfParts parts;
  parts.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::string rest = one_mesh("\"POSITION\":0", "");
  std::string letters;
  append_base64(letters, parts.binary());
  const std::string inside = parts.json(rest, ",\"uri\":\"data:application/octet-stream;base64," + letters + "\"");
  EXPECT_EQ(parse_gltf("\xef\xbb\xbf \n" + inside, "a.gltf").num_faces(), 1);
  const auto with = [&](const std::string& uri) {
    return directory.write("a.gltf", parts.json(rest, ",\"uri\":\"" + uri + "\""));
  };
  std::filesystem::create_directory(directory / "more");
  directory.write("more/the data.bin", parts.binary());
  EXPECT_EQ(read_mesh(with("more/the%20data.bin")).num_faces(), 1);
  EXPECT_EQ(read_mesh(with("./more/the data.bin")).num_faces(), 1);
  {  // the folder is that of the file, not the one that the program runs in
    const auto here = std::filesystem::current_path();
    std::filesystem::current_path(directory.path());
    EXPECT_EQ(read_mesh("a.gltf").num_faces(), 1);
    std::filesystem::current_path(here);
  }
  expect_error<IoError>([&] { (void)read_mesh(with("more")); }, {"a.gltf: buffers[0]: ", "more: cannot read"});
  expect_error<IoError>([&] { (void)read_mesh(with("none.bin")); }, {"a.gltf: buffers[0]: ", "none.bin: cannot read"});
  for (const char* const uri : {"../a.bin", "more/../../a.bin", "%2e%2E/a.bin", "more\\\\..\\\\..\\\\a.bin"})
    expect_error<FormatError>([&] { (void)read_mesh(with(uri)); }, {"buffers[0].uri: ", "leads out of the folder"});
  for (const char* const uri : {"http://a.b/c.bin", "file:///etc/passwd", "C:/a.bin", "%43:/a"})
    expect_error<FormatError>([&] { (void)read_mesh(with(uri)); }, {"is not a file beside; a relative path is right"});
  for (const char* const uri : {"/etc/passwd", "%2fetc/passwd", "", "\\\\a"})
    expect_error<FormatError>([&] { (void)read_mesh(with(uri)); }, {"is not a path relative to the file"});
  expect_error<FormatError>([&] { (void)read_mesh(with("a%zz")); }, {"is no path of a file"});
  expect_error<FormatError>([&] { (void)read_mesh(with("a%00b")); }, {"is no path of a file"});
  expect_error<FormatError>([&] { (void)read_mesh(with("data:,abc")); }, {"data in another way than base64"});
  expect_error<FormatError>([&] { (void)read_mesh(with("data:;base64,AA*A")); }, {"its data are not base64"});
  expect_error<FormatError>([&] { (void)read_mesh(with("data:;base64,AAAA")); },
                            {"buffers[0].byteLength: 36 bytes where there are 3"});
}

TEST(Gltf, BrokenFilesAreErrorsThatNameThePlace) {
  const auto expect = [](const std::string& bytes, const std::string& what) {
    expect_error<FormatError>([&] { (void)parse_gltf(bytes, "a.glb"); }, {"a.glb: " + what});
  };
  GltfParts parts;
  parts.positions(square_positions);
  parts.indices({0, 1, 2, 0, 2, 3});
  const std::string whole = parts.glb(one_mesh("\"POSITION\":0", ",\"indices\":1"));
  for (size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW((void)parse_gltf(whole.substr(0, size), "a.glb"), FormatError) << size;
  expect("", "the file is empty");
  expect("solid a", "it begins neither with 'glTF'");
  expect("glTF" + gltf_word(1) + whole.substr(8), "byte 4: version 1; binary glTF 2 can be read");
  expect(whole.substr(0, 8) + gltf_word(7) + whole.substr(12), "byte 8: 7 bytes are too few for a chunk");
  expect(whole.substr(0, 12) + gltf_word(1u << 30) + whole.substr(16), "byte 12: a chunk of 1073741824 bytes where ");
  expect(whole.substr(0, 16) + "BIN" + whole.substr(19), "byte 16: the first chunk is not JSON");
  expect(glb_of("{\"asset\":{\"version\":\"2.0\"},", ""), "the JSON chunk, line 1, column ");
  expect("{}", "it has no 'asset'");
  expect(R"({"asset":{"version":"1.0"}})", "asset.version: '1.0'; glTF 2.0 can be read");
  expect(R"({"asset":{"version":2}})", "asset.version: it should be a text");
  expect("{\"asset\":" + std::string(100000, '['), "line 1, column ");
  expect("{\"asset\":" + std::string(100000, '[') + std::string(100000, ']') + "}",
         "asset: it is of type array; it should be an object");
  expect(R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression","KHR_materials_unlit"]})",
         "extensionsRequired: 'KHR_draco_mesh_compression' cannot be read; export the file without");
  expect(R"({"asset":{"version":"2.0"},"scene":3})", "scene: 3 is out of range; the file has 0 scenes");
  expect(R"({"asset":{"version":"2.0"},"buffers":1e99})", "buffers: it should be an array");
  expect(R"({"asset":{"version":"2.0"},"x":1e999})", "number overflow");
  EXPECT_EQ(parse_gltf(whole + "more", "a.glb").warnings,
            (Words{"a.glb: byte " + std::to_string(whole.size()) + ": data behind the end ignored"}));
}

TEST(Gltf, WrongNumbersAreErrorsThatNameThePlace) {
  const auto broken = [](const std::string& from, const std::string& to) {
    GltfParts parts;
    parts.positions(square_positions);
    parts.indices({0, 1, 2, 0, 2, 3});
    std::string json = parts.json(one_mesh("\"POSITION\":0", ",\"indices\":1"));
    const size_t at = json.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return glb_of(json.replace(at, from.size(), to), parts.binary());
  };
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& what) {
    expect_error<FormatError>([&] { (void)parse_gltf(broken(from, to), "a.glb"); }, {"a.glb: " + what});
  };
  expect("\"count\":4", "\"count\":5",
         "accessors[0]: 5 rows of 12 bytes, 12 from one to the next, cannot be in the 48");
  expect("\"count\":4", "\"count\":1000000000", "accessors[0]: 1000000000 rows of 12 bytes");
  expect("\"count\":4", "\"count\":-1", "accessors[0].count: it should be a whole number");
  expect("\"count\":4", "\"count\":1.5", "accessors[0].count: it should be a whole number");
  expect("\"count\":4,", "", "accessors[0]: it has no 'count'");
  expect("5126", "5124", "accessors[0].componentType: 5124; ");
  expect("VEC3", "VEC9", "accessors[0].type: 'VEC9'; ");
  expect("VEC3", "VEC2", "accessors[0]: POSITION should have 3 columns");
  expect("5123", "5126", "accessors[1]: ");
  for (const char* const type : {"5120", "5122"})
    expect("5123", type, "accessors[1]: indices should be whole numbers without sign, one a row");
  expect("\"bufferView\":0", "\"bufferView\":7",
         "accessors[0].bufferView: 7 is out of range; the file has 2 buffer views");
  expect("\"bufferView\":0,", "", "accessors[0]: it has no 'bufferView'");
  expect("\"buffer\":0", "\"buffer\":1", "bufferViews[0].buffer: 1 is out of range");
  expect("\"buffer\":0", "\"extensions\":{\"EXT_meshopt_compression\":{}},\"buffer\":9",
         "bufferViews[0].buffer: 9 is out of range");
  expect("}],\"bufferViews\":[{\"buffer\":0",
         "},{\"byteLength\":60}],\"bufferViews\":[{\"extensions\":{\"EXT_meshopt_compression\":{}},\"buffer\":1",
         "bufferViews[0]: its data are compressed by 'EXT_meshopt_compression'");
  expect("}],\"bufferViews\":[{\"buffer\":0", "},{\"byteLength\":60}],\"bufferViews\":[{\"buffer\":1",
         "buffers[1]: it has neither a 'uri' nor a binary chunk");
  expect("\"byteOffset\":0", "\"byteOffset\":9007199254740992", "bufferViews[0]: bytes 9007199254740992 to ");
  expect("\"byteLength\":48", "\"byteLength\":9007199254740992", "bufferViews[0]: bytes 0 to ");
  expect("\"byteLength\":60", "\"byteLength\":61", "buffers[0].byteLength: 61 bytes where there are 60");
  expect("\"POSITION\":0", "\"POSITION\":9", "meshes[0].primitives[0].attributes.POSITION: 9 is out of range");
  expect("\"indices\":1", "\"indices\":1,\"mode\":7", "meshes[0].primitives[0].mode: 7; 0 to 6 are modes");
  expect("\"mesh\":0", "\"mesh\":1", "nodes[0].mesh: 1 is out of range");
  expect("\"mesh\":0", "\"mesh\":0,\"children\":[0]", "nodes[0]: it has two parents, or is below itself");
  expect("\"mesh\":0", "\"mesh\":0,\"children\":[1]",
         "nodes[0].children: an element is no number of one of the file's 1 nodes");
  expect("\"mesh\":0", "\"mesh\":0,\"matrix\":[1]", "nodes[0].matrix: it should have 16 numbers");
  expect("\"mesh\":0", "\"mesh\":0,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2]", "nodes[0].matrix: its last row");
  expect("\"mesh\":0", "\"mesh\":0,\"rotation\":[0,0,0,0]", "nodes[0].rotation: ");
  const auto expect_mesh = [&](const std::string& bytes, const std::string& what) {
    expect_error<InvalidMesh>([&] { (void)parse_gltf(bytes, "a.glb"); }, {"a.glb: " + what});
  };
  expect_mesh(broken("\"mesh\":0", "\"mesh\":0,\"scale\":[1e308,1,1],\"translation\":[1e308,0,0]"),
              "nodes[0]: a coordinate beyond");
  expect_mesh(broken("\"indices\":1", "\"indices\":1,\"mode\":1"),
              "no triangles; a mesh should have some; a.glb: meshes[0]: points or lines");
  GltfParts parts;
  parts.positions({0, 0, 0, 1, 0, 0, std::numeric_limits<float>::quiet_NaN(), 1, 0});
  expect_mesh(parts.glb(one_mesh("\"POSITION\":0", "")), "accessors[0]: a coordinate of row 2 is nan");
  parts.indices({0, 1, 3});
  expect_mesh(parts.glb(one_mesh("\"POSITION\":0", ",\"indices\":1")),
              "accessors[1]: index 3 is out of range; meshes[0].primitives[0] has 3 vertices");
}

// Sizes are checked before memory is taken: many nodes with one mesh, many zeros.
TEST(Gltf, ShortFilesDoNotTakeMuchMemory) {
  GltfParts parts;
  parts.positions(square_positions);
  parts.indices(std::vector<std::uint16_t>(30000, 0));
  std::string nodes = "\"nodes\":[";
  for (int i = 0; i < 2000; ++i) nodes += std::string(i ? "," : "") + "{\"mesh\":0}";
  std::vector<std::uint16_t> corners;
  for (int i = 0; i < 10000; ++i) corners.insert(corners.end(), {0, 1, std::uint16_t(2 + i % 2)});
  parts.indices(corners);
  const std::string bytes =
      parts.glb(nodes + R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":2}]}])");
  limit_memory(1 << 24);
  expect_error<ResourceError>([&] { (void)parse_gltf(bytes, "a.glb"); },
                              {"a.glb: 60000000 corners of faces take about"});
  limit_memory(std::numeric_limits<double>::infinity());
  GltfParts zeros;
  const int rows = zeros.add_view("\0"), values = zeros.add_view(std::string(12, '\0'));
  zeros.add_accessor(
      R"({"componentType":5126,"type":"VEC3","count":2147483647,"sparse":{"count":1,"indices":{"bufferView":)" +
      std::to_string(rows) + R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) + "}}}");
  expect_error<FormatError>([&] { (void)parse_gltf(zeros.glb(one_mesh("\"POSITION\":0", "")), "a.glb"); },
                            {"accessors[0].count: 2147483647 rows without a buffer view"});
}

TEST(Gltf, DeepTreesAndManyMaterialsAreRead) {
  std::string nodes = "\"nodes\":[", materials = "\"materials\":[";
  for (int i = 0; i < 100000; ++i) {
    nodes += "{\"children\":[" + std::to_string(i + 1) + "],\"translation\":[1,0,0]},";
    materials += std::string(i ? "," : "") + "{}";
  }
  const Mesh mesh = parse_gltf(square_with(nodes + "{\"mesh\":0}]," + materials + "]"), "a.glb");
  EXPECT_EQ(mesh.positions(0, 0), 100000);
}

TEST(Gltf, NumbersDoNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  const std::string bytes = square_with(R"("nodes":[{"mesh":0,"translation":[0.5,1.25e-1,0]}])");
  for (const char* const locale : {"C", "C.UTF-8", "de_DE.UTF-8", "fr_FR.UTF-8"}) {
    if (!std::setlocale(LC_ALL, locale)) continue;
    EXPECT_EQ(parse_gltf(bytes, "a.glb").positions.row(0), Eigen::RowVector3d(0.5, 0.125, 0)) << locale;
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Gltf, TheBeginningOfItsJsonIsKnown) {
  EXPECT_TRUE(begins_gltf("\xef\xbb\xbf{ \"asset\": {"));
  EXPECT_TRUE(begins_gltf("\n{\"accessors\":["));
  for (const char* const text : {"", "[\"asset\"]", "{\"kind\":\"bezier\"}", "asset"}) EXPECT_FALSE(begins_gltf(text));
}

TEST(Base64, LettersAreBytes) {
  const std::vector<std::pair<std::string, std::string>> pairs{{"", ""},
                                                               {"f", "Zg=="},
                                                               {"fo", "Zm8="},
                                                               {"foo", "Zm9v"},
                                                               {"foob", "Zm9vYg=="},
                                                               {"foobar", "Zm9vYmFy"},
                                                               {"\xff\xfe", "//4="}};  // RFC 4648, 10
  for (const auto& [bytes, letters] : pairs) {
    std::string made;
    append_base64(made, bytes);
    EXPECT_EQ(made, letters);
    EXPECT_EQ(parse_base64(letters), bytes);
    EXPECT_EQ(parse_base64(letters.substr(0, letters.find('='))), bytes);
  }
  for (const char* const wrong : {"A", "AA=A", "AAAA=", "A-AA", "AA A", "===="})
    EXPECT_FALSE(parse_base64(wrong)) << wrong;
}

}  // namespace
}  // namespace sublimit::testing
