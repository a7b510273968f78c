// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "meshes/meshes.h"
#include "sublimit/mesh/sharpness.h"
#include "sublimit/mesh/topology.h"
#include "sublimit/scheme/refined_mesh.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// A channel that names the vertex at every corner.
Mesh named_corners(Mesh mesh) {
  mesh.face_varying = {{"vertex", mesh.positions, mesh.face_vertices}};
  return mesh;
}

Mesh with_turned(Mesh mesh, const std::vector<Index>& faces) {
  for (const Index f : faces) {
    Index first = 0;
    for (Index g = 0; g < f; ++g) first += mesh.face_sizes[size_t(g)];
    for (std::vector<Index>* corners : {&mesh.face_vertices, &mesh.face_varying[0].indices})
      std::reverse(corners->begin() + first + 1, corners->begin() + first + mesh.face_sizes[size_t(f)]);
  }
  return mesh;
}

TEST(Tagging, FewFacesAreTurnedAndWindingIsConsistent) {
  std::mt19937 random(5);
  for (const Mesh& plain : {cube(), torus(6, 5), triangle_grid(5, 4), polygon_ring({5, 4, 3, 6, 4}),
                            disjoint_union(prism(5), grid(4, 3))}) {
    const Mesh mesh = named_corners(plain);
    for (int trial = 0; trial < 10; ++trial) {
      std::vector<Index> wrong;
      for (Index f = 0; f < mesh.num_faces(); ++f)
        if (random() % 6 == 0) wrong.push_back(f);
      if (2 * std::ssize(wrong) >= mesh.num_faces()) continue;
      Mesh turned = with_turned(mesh, wrong);
      const std::vector<Index> found = orient_faces(turned);
      EXPECT_LE(found.size(), wrong.size());
      EXPECT_TRUE(Topology(view(turned)).faults().empty());
      EXPECT_EQ(turned.face_varying[0].indices, turned.face_vertices);
      Mesh again = turned;
      EXPECT_TRUE(orient_faces(again).empty());
      EXPECT_EQ(again.face_vertices, turned.face_vertices);
    }
    Mesh same = mesh;
    EXPECT_TRUE(orient_faces(same).empty());
    EXPECT_EQ(same.face_vertices, mesh.face_vertices);
  }
}

TEST(Tagging, AStripOfOneSideKeepsAnEdge) {
  Mesh strip = mobius_strip(7);
  const size_t faults = Topology(view(strip)).faults().size();
  orient_faces(strip);
  EXPECT_EQ(Topology(view(strip)).faults().size(), faults);
  EXPECT_EQ(faults, 1u);
}

TEST(Tagging, EdgesThatBendBecomeSharp) {
  const double degree = std::numbers::pi / 180;
  const auto sharp = [](Mesh mesh, double angle) { return add_creases_by_angle(mesh, angle); };
  EXPECT_EQ(sharp(cube(), 89.9 * degree), 12);
  EXPECT_EQ(sharp(cube(), 90.1 * degree), 0);
  EXPECT_EQ(sharp(icosahedron(), 41 * degree), 30);  // 180 - 138.19 degrees
  EXPECT_EQ(sharp(icosahedron(), 42 * degree), 0);
  Mesh prismatic = prism(6);
  EXPECT_EQ(add_creases_by_angle(prismatic, 61 * degree), 12);  // of the two hexagons; the sides bend by 60
  for (const Mesh::Crease& crease : prismatic.creases) EXPECT_EQ(crease.sharpness, infinite_sharpness);
  Mesh tagged = cube();
  tagged.creases = {{0, 1, 0.5f}};
  EXPECT_EQ(add_creases_by_angle(tagged, 1), 11);  // one has a tag
  EXPECT_EQ(initial_sharpness(Topology(view(tagged)), tagged, Boundary::edge_only, Creasing::uniform).edge, [&] {
    Mesh right = cube();
    add_creases_by_angle(right, 1);
    right.creases.push_back({0, 1, 0.5f});
    return initial_sharpness(Topology(view(right)), right, Boundary::edge_only, Creasing::uniform).edge;
  }());
  Mesh flat = cube();
  flat.positions.col(2).setZero();  // sides have no area and no normal
  EXPECT_EQ(add_creases_by_angle(flat, 0), 0);
  expect_error<InvalidParameter>([&] { add_creases_by_angle(flat, -1); }, {"angle of creases is -1"});
}

TEST(Tagging, EdgesBetweenSmoothingGroupsBecomeSharp) {
  Mesh mesh = cube();
  expect_error<InvalidMesh>([&] { add_creases_by_smoothing_groups(mesh); }, {"no face has a smoothing group"});
  mesh.smoothing_groups = {{"1", "off"}, {0, 0, 0, 0, 0, 0}};
  EXPECT_EQ(add_creases_by_smoothing_groups(mesh), 0);
  mesh.smoothing_groups.of_face[2] = 1;
  EXPECT_EQ(add_creases_by_smoothing_groups(mesh), 4);
  mesh.creases.clear();
  mesh.smoothing_groups.of_face.assign(6, 1);
  EXPECT_EQ(add_creases_by_smoothing_groups(mesh), 12);
  mesh.creases.clear();
  mesh.smoothing_groups.of_face.assign(6, -1);
  EXPECT_EQ(add_creases_by_smoothing_groups(mesh), 12);
  mesh.smoothing_groups.of_face.pop_back();
  expect_error<InvalidMesh>([&] { add_creases_by_smoothing_groups(mesh); }, {"5 faces have names"});
}

// Each vertex of the border is one of the polygon's, or on one of its edges.
TEST(Tagging, AFixedBorderStays) {
  for (const auto& [mesh, scheme] :
       {std::pair(jittered(grid(4, 3)), "catmull-clark"), std::pair(jittered(triangle_grid(4, 3)), "loop")}) {
    Mesh fixed = mesh;
    fix_border(fixed);
    const Mesh fine = refined_mesh(*find_scheme(scheme), fixed, 3);
    const Topology coarse(view(mesh)), t(view(fine));
    const double size = mesh.positions.cwiseAbs().maxCoeff();
    Index count = 0;
    for (Index h = 0; h < t.num_half_edges(); ++h) {
      if (exists(t.twin(HalfEdge{h}))) continue;
      const Eigen::RowVector3d p = fine.positions.row(index(t.tail(HalfEdge{h})));
      double nearest = std::numeric_limits<double>::infinity();
      for (Index k = 0; k < coarse.num_half_edges(); ++k) {
        if (exists(coarse.twin(HalfEdge{k}))) continue;
        const Eigen::RowVector3d a = mesh.positions.row(index(coarse.tail(HalfEdge{k}))),
                                 ab = mesh.positions.row(index(coarse.head(HalfEdge{k}))) - a;
        const double t01 = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (p - a - t01 * ab).norm());
      }
      EXPECT_LT(nearest, rounding(20, size)) << scheme;
      ++count;
    }
    EXPECT_EQ(count, 8 * 14);
  }
}

}  // namespace
}  // namespace sublimit::testing
