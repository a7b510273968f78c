// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/gltf.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "meshes/meshes.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/split_mesh.h"
#include "sublimit/io/detail/gltf_mesh.h"
#include "sublimit/mesh/topology.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Two triangles with their normals and texture coordinates.
Mesh plate() {
  Mesh mesh;
  mesh.positions = (Points(4, 3) << 0, 0, 0.1, 1, 0, 0, 1, 1, -0.3, 0, 1, 0).finished();
  mesh.normals = (Points(4, 3) << 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1).finished();
  mesh.texture = (Points(4, 2) << 0, 0, 1, 0, 1, 0.75, 0, 1).finished();
  mesh.face_sizes = {3, 3};
  mesh.face_vertices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

tinygltf::Model read_back(const std::filesystem::path& path) {
  tinygltf::Model model;
  std::string errors, warnings;
  EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &errors, &warnings, path.string()));
  EXPECT_EQ(errors, "");
  EXPECT_EQ(warnings, "");
  return model;
}

template <class T>
std::vector<T> values(const tinygltf::Model& model, int number) {
  const tinygltf::Accessor& accessor = model.accessors.at(size_t(number));
  const tinygltf::BufferView& view = model.bufferViews.at(size_t(accessor.bufferView));
  EXPECT_EQ(view.byteLength, accessor.count * size_t(tinygltf::GetNumComponentsInType(uint32_t(accessor.type))) * 4);
  std::vector<T> all(view.byteLength / sizeof(T));
  std::memcpy(all.data(), model.buffers.at(0).data.data() + view.byteOffset, view.byteLength);
  return all;
}

std::vector<float> floats(const Points& rows) { return {rows.data(), rows.data() + rows.size()}; }

TEST(Glb, KeepsItsDigitsFarFromTheOrigin) {
  const TemporaryDirectory directory;
  Mesh mesh = plate();
  mesh.positions.rowwise() += Eigen::RowVector3d(1e7, -2e7, 1e7);
  write_glb(directory / "far.glb", mesh);
  const tinygltf::Model model = read_back(directory / "far.glb");
  const std::vector<double>& move = model.nodes.at(0).translation;
  ASSERT_EQ(move.size(), 3u);
  const int positions = model.meshes.at(0).primitives.at(0).attributes.at("POSITION");
  const std::vector<float> read = values<float>(model, positions);
  for (Eigen::Index i = 0; i < mesh.positions.size(); ++i)
    EXPECT_NEAR(double(read[size_t(i)]) + move[size_t(i % 3)], mesh.positions.data()[i], float_reference);
}

TEST(Glb, ReadsBackInTinyGltf) {
  const TemporaryDirectory directory;
  const Mesh mesh = plate();
  write_glb(directory / "plate.glb", mesh);
  const tinygltf::Model model = read_back(directory / "plate.glb");
  ASSERT_EQ(model.nodes.size(), 1u);
  EXPECT_EQ(model.nodes[0].name, "plate");
  EXPECT_EQ(model.scenes.at(size_t(model.defaultScene)).nodes, std::vector<int>{0});
  const tinygltf::Primitive& primitive = model.meshes.at(size_t(model.nodes[0].mesh)).primitives.at(0);
  EXPECT_EQ(primitive.mode, TINYGLTF_MODE_TRIANGLES);
  const int positions = primitive.attributes.at("POSITION");
  EXPECT_EQ(values<float>(model, positions), floats(mesh.positions));
  EXPECT_EQ(values<float>(model, primitive.attributes.at("NORMAL")), floats(mesh.normals));
  Points turned = mesh.texture;
  for (Eigen::Index i = 0; i < turned.rows(); ++i) turned(i, 1) = 1 - turned(i, 1);
  EXPECT_EQ(values<float>(model, primitive.attributes.at("TEXCOORD_0")), floats(turned));
  EXPECT_EQ(values<Index>(model, primitive.indices), mesh.face_vertices);
  EXPECT_EQ(model.accessors[size_t(positions)].minValues, (std::vector<double>{0, 0, double(-0.3f)}));
  EXPECT_EQ(model.accessors[size_t(positions)].maxValues, (std::vector<double>{1, 1, double(0.1f)}));
}

TEST(Glb, HasNoMeshWithoutTriangles) {
  const TemporaryDirectory directory;
  Mesh nothing;
  nothing.positions = nothing.normals = Points::Zero(0, 3);
  write_glb(directory / "nothing.glb", nothing);
  EXPECT_TRUE(read_back(directory / "nothing.glb").meshes.empty());
}

TEST(Glb, RefusesWhatTheFormatHasNot) {
  const TemporaryDirectory directory;
  const auto path = directory / "a.glb";
  const auto refused = [&](const auto& change, const std::string& what) {
    Mesh mesh = plate();
    change(mesh);
    expect_error<InvalidMesh>([&] { write_glb(path, mesh); }, {"a.glb: ", what});
    expect_error<InvalidMesh>([&] { write_gltf(path, mesh); }, {"a.glb: ", what});
    EXPECT_FALSE(std::filesystem::exists(path));
  };
  refused([](Mesh& mesh) { mesh.positions(0, 0) = 1e39; }, "a coordinate is beyond the numbers of 32 bits");
  refused([](Mesh& mesh) { mesh.positions(0, 0) = HUGE_VAL; }, "vertex 0 has a coordinate that is infinite");
  refused(
      [](Mesh& mesh) {
        mesh.face_varying = {{"uv", Points::Constant(1, 2, 1e39), {0, 0, 0, 0, 0, 0}}};
      },
      "a texture coordinate is beyond the numbers of 32 bits");
  refused([](Mesh& mesh) { mesh.vertex_values = {{"heat", {0, 1, 1e39, 0}}}; }, "value 'heat' of vertex 2 is 1e+39");
  refused(
      [](Mesh& mesh) {
        mesh.vertex_values = {{"heat", {0, 1, 0, std::nan("")}}};
      },
      "value 'heat' of vertex 3 is nan; a glTF file has finite numbers of 32 bits; write a .ply");
}

/// A corner of a face, with all that a file keeps of it: coordinates, texture coordinates, values.
using CornerNumbers = std::vector<double>;
struct FaceContents {
  std::string object, material;
  std::vector<CornerNumbers> corners;  ///< from the least one on
  auto operator<=>(const FaceContents&) const = default;
};

/// The faces of a mesh in an order of their own: equal for meshes that differ in the order of faces and vertices, and
/// in the first corners of faces.
std::vector<FaceContents> contents_of(Mesh mesh) {
  std::ranges::sort(mesh.vertex_values, {}, &Mesh::Values::name);
  std::vector<FaceContents> faces;
  size_t corner = 0;
  const auto name = [](const Mesh::FaceNames& names, size_t f) {
    return names.of_face.empty() || names.of_face[f] < 0 ? "" : names.names[size_t(names.of_face[f])];
  };
  for (size_t f = 0; f < mesh.face_sizes.size(); ++f) {
    FaceContents face{name(mesh.objects, f), name(mesh.materials, f), {}};
    for (Index k = 0; k < mesh.face_sizes[f]; ++k, ++corner) {
      const Index v = mesh.face_vertices[corner];
      CornerNumbers numbers{mesh.positions(v, 0), mesh.positions(v, 1), mesh.positions(v, 2)};
      if (!mesh.face_varying.empty())
        for (Eigen::Index i = 0; i < 2; ++i)
          numbers.push_back(mesh.face_varying[0].values(mesh.face_varying[0].indices[corner], i));
      for (const Mesh::Values& one : mesh.vertex_values) numbers.push_back(one.values[size_t(v)]);
      face.corners.push_back(numbers);
    }
    std::ranges::rotate(face.corners, std::ranges::min_element(face.corners));
    faces.push_back(face);
  }
  std::ranges::sort(faces);
  return faces;
}

/// Expects that both kinds of files give back a mesh.
void expect_comes_back(const Mesh& mesh) {
  const TemporaryDirectory directory;
  write_glb(directory / "a.glb", mesh);
  write_gltf(directory / "a.gltf", mesh);
  Mesh expected = mesh;
  if (mesh.objects.of_face.empty()) expected.objects = {{"a"}, std::vector<Index>(mesh.face_sizes.size(), 0)};
  for (const std::string name : {"a.glb", "a.gltf"}) {
    const Mesh read = read_gltf(directory / name);
    EXPECT_TRUE(contents_of(read) == contents_of(expected));
    EXPECT_EQ(read.num_vertices(), mesh.num_vertices());
    const Topology before(view(mesh)), after(view(read));
    EXPECT_EQ(after.num_edges(), before.num_edges());
    ASSERT_EQ(read.vertex_values.size(), mesh.vertex_values.size());
    for (const Mesh::Values& one : mesh.vertex_values) {
      const auto found = std::ranges::find(read.vertex_values, one.name, &Mesh::Values::name);
      ASSERT_NE(found, read.vertex_values.end()) << one.name;
      EXPECT_EQ(found->type, one.type) << one.name;
    }
    EXPECT_TRUE(read.warnings.empty());
    const auto again = directory / "again.glb";  // and what was read is written as it was
    write_glb(again, read);
    EXPECT_TRUE(contents_of(read_gltf(again)) == contents_of(read));
  }
}

/// Numbers that are floats, and stay so under t -> 1 - t.
Points short_numbers(Eigen::Index rows, Eigen::Index columns) {
  return (Points::Random(rows, columns) * 4096).array().round() / 4096;
}

Mesh with_short_numbers(const Mesh& shape) {
  Mesh mesh = jittered(shape);
  mesh.positions = (mesh.positions * 4096).array().round() / 4096;
  return mesh;
}

void add_names(Mesh& mesh) {
  mesh.objects.names = {"left wing", "right \"wing\"", "\xc3\xa4"};
  mesh.materials.names = {"steel", "glass"};
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    mesh.objects.of_face.push_back(f % 4 - 1);
    mesh.materials.of_face.push_back(f / 2 % 3 - 1);
  }
}

void add_texture(Mesh& mesh) {
  mesh.face_varying = {{"uv", short_numbers(7, 2), {}}};
  for (size_t c = 0; c < mesh.face_vertices.size(); ++c) mesh.face_varying[0].indices.push_back(Index(c % 7));
}

void add_values(Mesh& mesh, ValueType type) {
  for (const char* const name : {"blue", "green", "heat", "red"}) {
    mesh.vertex_values.push_back({name, {}, type});
    for (Index v = 0; v < mesh.num_vertices(); ++v)
      mesh.vertex_values.back().values.push_back(type == ValueType::float32 ? (v + name[0] % 8) / 256.0
                                                                            : double((7 * v + name[0]) % 256));
  }
}

// Polygons, seams, names and values, on closed surfaces that objects and materials cut.
TEST(Glb, MeshesComeBack) {
  for (const Mesh& shape : {cube(), octahedron(), torus(8, 6), icosahedron(), prism(7), pole(9)}) {
    Mesh mesh = with_short_numbers(shape);
    expect_comes_back(mesh);
    add_names(mesh);
    expect_comes_back(mesh);
    add_texture(mesh);
    expect_comes_back(mesh);
    for (const ValueType type : {ValueType::uint8, ValueType::uint16, ValueType::float32}) {
      Mesh valued = mesh;
      add_values(valued, type);
      expect_comes_back(valued);
    }
  }
}

// Vertices at one place that are several stay so, in one object and in two.
TEST(Glb, DoubleVerticesStayApart) {
  Mesh two = cube();
  const Mesh one = two;
  two.positions.conservativeResize(16, 3);
  two.positions.bottomRows(8) = one.positions.rowwise() + Eigen::RowVector3d(2, 0, 0);  // a common side
  two.face_sizes.insert(two.face_sizes.end(), one.face_sizes.begin(), one.face_sizes.end());
  for (const Index v : one.face_vertices) two.face_vertices.push_back(v + 8);
  expect_comes_back(two);
  two.objects = {{"left", "right"}, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}};
  expect_comes_back(two);
  EXPECT_EQ(format_glb(two).find(gltf_vertex_attribute), std::string::npos) << "objects are welded by themselves";
}

TEST(Glb, CoordinatesAreTheSameFloatsFromAnyMiddle) {
  Mesh mesh = with_short_numbers(torus(8, 6));
  mesh.positions.rowwise() += Eigen::RowVector3d(1 << 20, -(1 << 21), 1 << 22);
  expect_comes_back(mesh);
  add_names(mesh);
  expect_comes_back(mesh);
}

// Vertices in no face are not in the mesh that comes back.
TEST(Glb, VerticesInNoFaceAreLeftOut) {
  Mesh mesh = octahedron();
  mesh.positions.conservativeResize(8, 3);
  mesh.positions.bottomRows(2).setConstant(7);
  EXPECT_EQ(parse_gltf(format_glb(mesh), "a.glb").positions, octahedron().positions);
}

// Every triangle of a face is on its inner side: areas seen along its normal add up to that of the face, none below 0.
TEST(Glb, TrianglesStayInFacesThatAreNotConvex) {
  const std::vector<std::vector<Eigen::RowVector3d>> polygons{
      {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}},                        // an arrow
      {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 3, 0}, {1, 2, 0}, {0, 3, 0}},  // a bow
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}},             // three corners on a line
      {{0, 0, 0},
       {6, 0, 0},
       {6, 5, 0},
       {5, 5, 0},
       {5, 1, 0},
       {4, 1, 0},
       {4, 5, 0},
       {3, 5, 0},
       {3, 1, 0},
       {1, 1, 0},
       {1, 5, 0},
       {0, 5, 0}}};  // a comb, which no fan fills
  for (const auto& polygon : polygons)
    for (size_t turn = 0; turn < polygon.size(); ++turn) {
      Mesh mesh;
      mesh.positions.resize(std::ssize(polygon), 3);
      for (size_t i = 0; i < polygon.size(); ++i) {
        mesh.positions.row(Eigen::Index(i)) = polygon[(i + turn) % polygon.size()];
        mesh.face_vertices.push_back(Index(i));
      }
      mesh.face_sizes = {Index(polygon.size())};
      std::string bytes = format_glb(mesh);
      for (size_t at; (at = bytes.find("FB_ngon")) != std::string::npos;)
        bytes[at] = 'X';  // triangles as others see them
      const Mesh read = parse_gltf(bytes, "a.glb");
      ASSERT_EQ(read.num_faces(), Index(polygon.size()) - 2);
      double area = 0, whole = 0;
      for (size_t i = 0; i < polygon.size(); ++i) {
        const auto &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        whole += p[0] * q[1] - p[1] * q[0];
      }
      for (Index f = 0; f < read.num_faces(); ++f) {
        const auto at = [&](Index k) { return read.positions.row(read.face_vertices[size_t(3 * f + k)]); };
        const double one =
            (at(1)[0] - at(0)[0]) * (at(2)[1] - at(0)[1]) - (at(1)[1] - at(0)[1]) * (at(2)[0] - at(0)[0]);
        EXPECT_GT(one, 0);
        area += one;
      }
      EXPECT_EQ(area, whole);
    }
}

TEST(Glb, ObjectsAreNodesAndMaterialsPrimitivesInTinyGltf) {
  const TemporaryDirectory directory;
  Mesh mesh = octahedron();
  add_names(mesh);
  add_values(mesh, ValueType::uint8);
  write_glb(directory / "a.glb", mesh);
  write_gltf(directory / "a.gltf", mesh);
  const tinygltf::Model model = read_back(directory / "a.glb");
  std::vector<std::string> names;
  for (const tinygltf::Node& node : model.nodes) names.push_back(node.name);
  EXPECT_EQ(names, (std::vector<std::string>{"", "left wing", "right \"wing\"", "\xc3\xa4"}));
  size_t triangles = 0;
  for (const tinygltf::Mesh& one : model.meshes)
    for (const tinygltf::Primitive& primitive : one.primitives) {
      triangles += model.accessors.at(size_t(primitive.indices)).count / 3;
      EXPECT_TRUE(primitive.attributes.contains("COLOR_0") && primitive.attributes.contains("_heat"));
      EXPECT_LT(primitive.material, 2);
    }
  EXPECT_EQ(triangles, 8u);
  ASSERT_EQ(model.materials.size(), 2u);
  EXPECT_EQ((std::set{model.materials[0].name, model.materials[1].name}), (std::set<std::string>{"glass", "steel"}));
  tinygltf::Model text;
  std::string errors, warnings;
  EXPECT_TRUE(tinygltf::TinyGLTF().LoadASCIIFromFile(&text, &errors, &warnings, (directory / "a.gltf").string()));
  EXPECT_EQ(errors + warnings, "");
  EXPECT_EQ(text.buffers.at(0).data, model.buffers.at(0).data);
  EXPECT_EQ(text.nodes, model.nodes);
  EXPECT_EQ(text.meshes, model.meshes);
}

TEST(Glb, WhatAFileChangesIsTold) {
  Mesh mesh = plate();
  mesh.vertex_values = {{"red", {0, 1.5, 0, -1}},
                        {"green", {0, 1, 0.5, 1}},
                        {"blue", {0, 1, 0, 1}},
                        {"part", {16777216, 16777217, 0, -16777219}, ValueType::int32},
                        {"mark", {0, 300, 255.4, -1}, ValueType::uint8},
                        {"heat", {0.1, 1e-300, 0, 0}}};
  EXPECT_EQ(changes_in_gltf(mesh),
            (std::vector<std::string>{
                "values 'part' beyond the whole numbers that floats have, 2 of them, are rounded",
                "values 'mark' beyond their type, 2 of them, are cut off",
                "numbers of colours of vertices beyond 0 to 1, 2 of them, are cut off; a .ply of type float or double "
                "keeps them"}));
  const Mesh read = parse_gltf(format_glb(mesh), "a.glb");
  const auto values = [&](const std::string& name) {
    return std::ranges::find(read.vertex_values, name, &Mesh::Values::name)->values;
  };
  EXPECT_EQ(values("red"), (std::vector<double>{0, 1, 0, 0}));
  EXPECT_EQ(values("mark"), (std::vector<double>{0, 255, 255, 0}));
  EXPECT_EQ(values("part"), (std::vector<double>{16777216, 16777216, 0, -16777220}));
  mesh.vertex_values.clear();
  EXPECT_TRUE(changes_in_gltf(mesh).empty());
}

// Two values of one name, and one of the name that numbers of vertices have: each has an attribute.
TEST(Glb, ValuesOfOneNameHaveAttributesOfTheirOwn) {
  Mesh mesh = plate();
  mesh.vertex_values = {{"heat", {0, 1, 2, 3}, ValueType::float32},
                        {"heat", {4, 5, 6, 7}, ValueType::float32},
                        {"VERTEX", {8, 9, 10, 11}, ValueType::float32},
                        {"red", {0, 0, 1, 1}, ValueType::float32}};
  const Mesh read = parse_gltf(format_glb(mesh), "a.glb");
  std::vector<std::pair<std::string, double>> last;
  for (const Mesh::Values& one : read.vertex_values) last.emplace_back(one.name, one.values[3]);
  std::ranges::sort(last);
  EXPECT_EQ(last,
            (std::vector<std::pair<std::string, double>>{{"VERTEX_", 11}, {"heat", 3}, {"heat_", 7}, {"red", 1}}));
}

TEST(Glb, FilesAreTheSameForAnyNumberOfThreads) {
  const TemporaryDirectory directory;
  Mesh mesh = torus(200, 70);
  add_texture(mesh);
  const auto path = directory / "mesh.glb";  // the name that `format_glb` takes
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    write_glb(path, mesh);
    EXPECT_EQ(read_file(path), format_glb(mesh));
  }
}

TEST(SplitMesh, CutsWhereValuesOrNormalsDiffer) {
  Mesh mesh = plate();
  mesh.texture.resize(0, 2);
  const SplitMesh whole = split_mesh(mesh);
  EXPECT_EQ(whole.sources, (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(whole.mesh.face_vertices, mesh.face_vertices);
  EXPECT_EQ(whole.mesh.normals, mesh.normals);
  EXPECT_EQ(whole.sides, (std::vector<Index>{-1, -1, -1, -1}));
  // Vertex 2 has two values, vertex 0 has two normals.
  mesh.face_varying = {{"uv", (Points(2, 2) << 0, 0.5, 1, 0.25).finished(), {0, 0, 0, 0, 1, 0}}};
  mesh.normals = (Points(3, 3) << 0, 0, 1, 0, 1, 0, 0, 0, 1).finished();
  mesh.face_normals = {0, 0, 0, 1, 2, 2};
  const SplitMesh split = split_mesh(mesh);
  EXPECT_EQ(split.sources, (std::vector<Index>{0, 0, 1, 2, 2, 3}));
  EXPECT_EQ(split.mesh.face_vertices, (std::vector<Index>{0, 2, 3, 1, 4, 5}));
  EXPECT_EQ(split.mesh.positions.row(4), mesh.positions.row(2));
  EXPECT_EQ(split.mesh.texture.row(4), mesh.face_varying[0].values.row(1));
  EXPECT_EQ(split.mesh.normals.row(1), mesh.normals.row(1));
  EXPECT_EQ(split.sides, (std::vector<Index>{0, 3, -1, -1, -1, -1}));
}

}  // namespace
}  // namespace sublimit::testing
