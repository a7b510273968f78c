// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/thinning.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "meshes/meshes.h"
#include "sublimit/geometric/torus_pieces.h"
#include "sublimit/mesh/topology.h"
#include "support/expect_error.h"
#include "truth/deviation.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;

/// x^2/4 + y^2 + z^2 = 1: bent most at its two tips.
const ImplicitSurface oblate{[](const Vector3d& x) {
  const Vector3d a(0.25, 1, 1);
  return ImplicitSurface::Jet{x.dot(a.cwiseProduct(x)) - 1, 2 * a.cwiseProduct(x), 2 * a.asDiagonal().toDenseMatrix()};
}};
CurvatureMesh fine() {
  Mesh mesh = icosahedron();
  mesh.positions.rowwise().normalize();
  mesh.positions.col(0) *= 2;
  return refine(torus_pieces({}), curvature_mesh(mesh, targets_on(oblate, mesh)), 3);
}

TEST(Thinning, KeepsTheBentPointsOfAManifold) {
  const CurvatureMesh mesh = fine(), thin = thinned(mesh, 200);
  ASSERT_EQ(thin.num_vertices(), 200);
  const Topology topology(view(thin));
  EXPECT_TRUE(topology.faults().empty());
  EXPECT_EQ(topology.num_vertices() - topology.num_edges() + topology.num_faces(), 2);
  const auto bending = [](const SurfacePoint& p) { return p.k1 * p.k1 + p.k2 * p.k2; };
  double before = 0, after = 0;
  for (const SurfacePoint& p : mesh.points) before += bending(p) / mesh.num_vertices();
  for (const SurfacePoint& p : thin.points) after += bending(p) / thin.num_vertices();
  EXPECT_GT(after, 1.2 * before);
  for (Index v = 0; v < 12; ++v) EXPECT_EQ(thin.points[v].position, mesh.points[v].position);
  EXPECT_EQ(std::ranges::count(thin.original, true), 12);
  for (Index f = 0; f < thin.num_faces(); ++f) {
    const auto at = [&](Index i) { return thin.points[thin.triangles[3 * f + i]].position; };
    const Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    for (Index i = 0; i < 3; ++i) EXPECT_GT(normal.dot(thin.points[thin.triangles[3 * f + i]].normal), 0.5);
  }
}

TEST(Thinning, KeepsGivenPointsAndBorders) {
  const CurvatureMesh mesh = fine();
  EXPECT_EQ(thinned(mesh, mesh.num_vertices()).triangles, mesh.triangles);
  EXPECT_GE(thinned(mesh, 0).num_vertices(), 12);
  EXPECT_LT(thinned(mesh, 0).num_vertices(), 60);
  CurvatureMesh given = mesh;
  given.original = {};
  EXPECT_EQ(thinned(given, 0).triangles, mesh.triangles);
  expect_error<InvalidParameter>([&] { thinned(mesh, -1); }, {"-1"});

  Mesh grid = triangle_grid(3, 3);
  grid.positions.col(2).setZero();
  std::vector<VertexTarget> targets;
  for (Index v = 0; v < grid.num_vertices(); ++v)
    targets.push_back(
        {v, grid.positions.row(v).transpose(), Vector3d::UnitZ(), TargetCurvature{0, 0, Vector3d::UnitX()}});
  const CurvatureMesh flat = refine(torus_pieces({}), curvature_mesh(grid, targets), 1), thin = thinned(flat, 0);
  // Given points and those of the border's edges stay; of the others some may have no place to go.
  for (Index v = 0; v < flat.num_vertices(); ++v) {
    const Vector3d& x = flat.points[v].position;
    const bool stays = flat.original[v] || Topology(view(flat)).is_boundary(Vertex{v});
    if (stays) {
      EXPECT_TRUE(std::ranges::any_of(thin.points, [&](const SurfacePoint& p) { return p.position == x; })) << v;
    }
  }
  EXPECT_LT(thin.num_vertices(), 16 + 12 + 21 / 2);
  EXPECT_TRUE(Topology(view(thin)).faults().empty());
}

}  // namespace
}  // namespace sublimit::testing
