// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/curvature_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "meshes/meshes.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;

/// Exact data of the unit sphere.
std::vector<VertexTarget> sphere_targets(const Mesh& mesh) {
  std::vector<VertexTarget> targets;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const Vector3d normal = Vector3d(mesh.positions.row(v)).normalized();
    targets.push_back({v, normal, normal, TargetCurvature{-1, -1, normal.unitOrthogonal()}});
  }
  return targets;
}

template <class Expected, class Change>
void expect_refused(const Change& change, std::initializer_list<std::string_view> parts) {
  const Mesh mesh = octahedron();
  std::vector<VertexTarget> targets = sphere_targets(mesh);
  change(targets);
  expect_error<Expected>([&] { curvature_mesh(mesh, targets); }, parts);
}

TEST(CurvatureMesh, RefusesBadTargetsAndSaysWhere) {
  using Targets = std::vector<VertexTarget>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused<InvalidMesh>([](Targets& t) { t.pop_back(); }, {"vertex 5", "no target"});
  expect_refused<InvalidMesh>([](Targets& t) { t[2].vertex = 1; }, {"vertex 1", "several"});
  expect_refused<InvalidMesh>([](Targets& t) { t[2].vertex = 6; }, {"vertex 6", "0 to 5"});
  expect_refused<InvalidMesh>([](Targets& t) { t[2].vertex = -1; }, {"vertex -1", "0 to 5"});
  expect_refused<InvalidMesh>([](Targets& t) { t[3].normal.reset(); }, {"vertex 3", "no normal"});
  expect_refused<InvalidMesh>([](Targets& t) { t[3].curvature.reset(); }, {"vertex 3", "no curvatures", "direction"});
  expect_refused<InvalidMesh>([](Targets& t) { t[4].normal = Vector3d::Zero(); }, {"vertex 4", "normal", "length 0"});
  expect_refused<InvalidMesh>([](Targets& t) { t[4].curvature->direction1.setZero(); },
                              {"vertex 4", "direction", "length 0"});
  expect_refused<InvalidMesh>([&](Targets& t) { t[4].position[1] = nan; }, {"vertex 4", "position", "finite"});
  expect_refused<InvalidMesh>([&](Targets& t) { (*t[4].normal)[1] = nan; }, {"vertex 4", "normal", "finite"});
  expect_refused<InvalidMesh>([&](Targets& t) { t[4].curvature->k2 = nan; }, {"vertex 4", "curvatures", "finite"});
  expect_refused<InvalidMesh>([&](Targets& t) { t[4].curvature->k1 = 1 / 0.0; }, {"vertex 4", "curvatures", "finite"});
  expect_refused<InvalidMesh>([](Targets& t) { t[1].curvature->direction1 += 0.1 * *t[1].normal; },
                              {"vertex 1", "tangent plane", "0.0996686524911", "right angles"});  // atan(0.1)
}

TEST(CurvatureMesh, MakesLengthsAndAnglesExact) {
  const Mesh mesh = octahedron();
  std::vector<VertexTarget> targets = sphere_targets(mesh);
  targets[0].normal = *targets[0].normal * 1e-200;
  targets[1].curvature->direction1 += 1e-7 * *targets[1].normal;
  targets[2].curvature->direction1 *= 1e200;
  const CurvatureMesh data = curvature_mesh(mesh, targets);
  for (const SurfacePoint& p : data.points) {
    EXPECT_NEAR(p.normal.norm(), 1, rounding(3));
    EXPECT_NEAR(p.direction1.norm(), 1, rounding(3));
    EXPECT_NEAR(p.normal.dot(p.direction1), 0, rounding(3));
  }
  const CurvatureMesh again = checked(data);
  for (Index v = 0; v < data.num_vertices(); ++v) {
    EXPECT_EQ(data.points[v].normal, again.points[v].normal);
    EXPECT_EQ(data.points[v].direction1, again.points[v].direction1);
  }
}

TEST(CurvatureMesh, CutsQuadsAlongTheirShorterDiagonal) {
  Mesh mesh = cube();
  std::vector<VertexTarget> targets = sphere_targets(mesh);
  EXPECT_EQ(curvature_mesh(mesh, targets).num_faces(), 12);
  const Mesh quad = make_mesh({{0, 0, 0}, {1, 0, 0}, {3, 3, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
  targets.resize(4);
  for (Index v = 0; v < 4; ++v)
    targets[v] = {v, quad.positions.row(v).transpose(), Vector3d::UnitZ(), TargetCurvature{0, 0, Vector3d::UnitX()}};
  EXPECT_EQ(curvature_mesh(quad, targets).triangles, (std::vector<Index>{0, 1, 3, 1, 2, 3}));
  targets[2].position = {1, 1, 0};  // a square
  EXPECT_EQ(curvature_mesh(quad, targets).triangles, (std::vector<Index>{0, 1, 2, 0, 2, 3}));
}

TEST(CurvatureMesh, RefusesWhatIsNoTriangulatedSurface) {
  const auto with = [](const std::vector<std::vector<Index>>& faces, Index n = 5) {
    std::vector<Vector3d> positions;
    for (Index i = 0; i < n; ++i) positions.emplace_back(i, i * i, 1);
    const Mesh mesh = make_mesh(positions, faces);
    return [mesh] { curvature_mesh(mesh, sphere_targets(mesh)); };
  };
  expect_error<UnsupportedTopology>(with({{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}), {"0,1", "manifold"});
  expect_error<UnsupportedTopology>(with({{0, 1, 2}, {0, 3, 4}}), {"0", "manifold"});
  expect_error<UnsupportedTopology>(with({{0, 1, 2, 3, 4}}), {"face 0", "5 corners"});
  expect_error<UnsupportedTopology>(with({{0, 1, 2}}, 4), {"3", "manifold"});
  expect_error<InvalidMesh>(with({{0, 1, 7}}), {"7"});
  expect_error<InvalidMesh>([] { checked(CurvatureMesh{}); }, {"no faces"});
  expect_error<InvalidMesh>([] { checked({.triangles = {0, 1}, .points = {{}, {}}}); }, {"2 corners"});
  CurvatureMesh long_normal{.triangles = {0, 1, 2}, .points = {{}, {}, {}}};
  long_normal.points[1].normal *= 2;
  expect_error<InvalidMesh>([&] { checked(long_normal); }, {"vertex 1", "normal", "length 2"});
}

}  // namespace
}  // namespace sublimit::testing
