// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/glb.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>

#include "meshes/meshes.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/formats/split_mesh.h"
#include "support/temporary_directory.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Two triangles with their normals and texture coordinates.
Mesh square() {
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
  Mesh mesh = square();
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
  const Mesh mesh = square();
  write_glb(directory / "square.glb", mesh);
  const tinygltf::Model model = read_back(directory / "square.glb");
  ASSERT_EQ(model.nodes.size(), 1u);
  EXPECT_EQ(model.nodes[0].name, "square");
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
  Mesh large = square(), polygon = square(), corners = square(), infinite = square();
  large.positions(0, 0) = 1e39;
  EXPECT_THROW(write_glb(path, large), InvalidMesh);
  infinite.positions(0, 0) = HUGE_VAL;
  EXPECT_THROW(write_glb(path, infinite), InvalidMesh);
  polygon.face_sizes = {6};
  EXPECT_THROW(write_glb(path, polygon), InvalidParameter);
  corners.face_normals = {0, 1, 2, 0, 2, 3};
  EXPECT_THROW(write_glb(path, corners), InvalidParameter);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(SplitMesh, CutsWhereValuesOrNormalsDiffer) {
  Mesh mesh = square();
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
