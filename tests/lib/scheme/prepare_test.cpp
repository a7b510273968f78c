// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/detail/prepare.h"

#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/sharpness.h"

namespace sublimit::testing {
namespace {

TEST(Prepare, TriangulatedIsAFanFromTheFirstCorner) {
  Mesh mesh =
      make_mesh({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}, {1, 4, 0}}, {{1, 2, 3, 4, 0}, {4, 3, 5}});
  mesh.holes = {0};
  mesh.creases = {{3, 4, 2}};
  mesh.corners = {{5, 10}};
  mesh.boundary = Boundary::edge_only;
  mesh.groups = {{"a", "b"}, {1, 0}};
  const Mesh cut = triangulated(mesh);
  EXPECT_EQ(cut.face_sizes, (std::vector<Index>{3, 3, 3, 3}));
  EXPECT_EQ(cut.face_vertices, (std::vector<Index>{1, 2, 3, 1, 3, 4, 1, 4, 0, 4, 3, 5}));
  EXPECT_EQ(cut.holes, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(cut.positions, mesh.positions);
  ASSERT_EQ(cut.creases.size(), 1u);
  EXPECT_EQ(cut.creases[0].sharpness, 2);
  EXPECT_EQ(cut.corners.size(), 1u);
  EXPECT_EQ(cut.groups.names, mesh.groups.names);
  EXPECT_EQ(cut.groups.of_face, (std::vector<Index>{1, 1, 1, 0}));
  EXPECT_EQ(cut.boundary, Boundary::edge_only);
}

// An n-gon becomes n - 2 triangles with n - 3 new edges: the Euler characteristic stays. Triangles stay as they are.
TEST(Prepare, TriangulatedKeepsTheSurface) {
  for (const Mesh& mesh : {cube(), torus(4, 5), prism(7), grid(3, 2), icosahedron()}) {
    const Topology t(view(mesh)), cut(view(triangulated(mesh)));
    EXPECT_EQ(cut.uniform_face_size(), 3);
    EXPECT_EQ(cut.num_vertices(), t.num_vertices());
    EXPECT_EQ(cut.num_faces(), t.num_half_edges() - 2 * t.num_faces());
    EXPECT_EQ(cut.num_edges(), t.num_edges() + t.num_half_edges() - 3 * t.num_faces());
    EXPECT_TRUE(cut.faults().empty());
  }
  EXPECT_EQ(triangulated(icosahedron()).face_vertices, icosahedron().face_vertices);
}

TEST(Prepare, TriangulatedKeepsSharpEdgesSharp) {
  Mesh mesh = cube();
  add_crease(mesh, {0, 1, 3, 2, 0}, 3);
  const Mesh cut = triangulated(mesh);
  const Topology t(view(cut));
  const Sharpness s = initial_sharpness(t, cut, Boundary::edge_and_corner, Creasing::uniform);
  int sharp = 0;
  for (Index e = 0; e < t.num_edges(); ++e) sharp += s.edge[e] == 3;
  EXPECT_EQ(sharp, 4);
}

TEST(Prepare, TriangulatedKeepsValuesAtTheirCorners) {
  Mesh mesh = polygon_ring({5, 4, 3, 6, 4});
  Mesh::FaceVarying channel{.name = "uv", .values = Points::Zero(Index(mesh.face_vertices.size()), 2), .indices = {}};
  for (Index i = 0; i < channel.values.rows(); ++i) {  // every corner its own value, which says where it is
    channel.values(i, 0) = mesh.face_vertices[i];
    channel.indices.push_back(i);
  }
  mesh.face_varying = {channel};
  const Mesh cut = triangulated(mesh);
  ASSERT_EQ(cut.face_varying[0].indices.size(), cut.face_vertices.size());
  for (size_t i = 0; i < cut.face_vertices.size(); ++i)
    EXPECT_EQ(cut.face_varying[0].values(cut.face_varying[0].indices[i], 0), cut.face_vertices[i]);
  mesh.face_varying[0].indices.pop_back();
  EXPECT_THROW(triangulated(mesh), InvalidMesh);
}

TEST(Prepare, TriangulatedRejectsWhatIsNoMesh) {
  Mesh mesh = cube();
  mesh.holes = {6};
  EXPECT_THROW(triangulated(mesh), InvalidMesh);
  mesh = cube();
  mesh.face_sizes[0] = 2;
  EXPECT_THROW(triangulated(mesh), InvalidMesh);
  mesh = cube();
  mesh.face_vertices.pop_back();
  EXPECT_THROW(triangulated(mesh), InvalidMesh);
  mesh = cube();
  mesh.groups = {{"a"}, {0, 0}};
  EXPECT_THROW(triangulated(mesh), InvalidMesh);
}

TEST(Prepare, WithoutCreasesKeepsTheRest) {
  Mesh mesh = grid(2, 2);
  add_crease(mesh, {1, 4, 7}, 3);
  mesh.corners = {{4, 2}};
  mesh.holes = {1};
  mesh.boundary = Boundary::none;
  const Mesh plain = without_creases(mesh);
  EXPECT_TRUE(plain.creases.empty());
  EXPECT_TRUE(plain.corners.empty());
  EXPECT_EQ(plain.holes, mesh.holes);
  EXPECT_EQ(plain.boundary, Boundary::none);
  EXPECT_EQ(plain.face_vertices, mesh.face_vertices);
}

}  // namespace
}  // namespace sublimit::testing
