// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/limit_integrals.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <numbers>

#include "sublimit/base/error.h"
#include "sublimit/schemes.h"
#include "sublimit/tessellation/tessellate.h"
#include "support/meshes.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

using namespace testing;

LimitIntegrals integrals(const char* scheme, const ControlMesh& mesh) {
  return limit_integrals(LimitSurface(find_scheme(scheme).value(), mesh), mesh.positions);
}

constexpr double summed = 1e-13;         ///< sums of some thousand parts, relative
constexpr double area_accuracy = 1e-10;  ///< what areas promise

TEST(LimitIntegrals, OfABoxAreItsOwn) {
  ControlMesh box = cube();  // [-1,1]^3
  box.positions.col(0) *= 0.5;
  box.positions.col(1) *= 2;
  box.positions.rowwise() += Eigen::RowVector3d(3, -1, 7);
  const LimitIntegrals found = integrals("bilinear", box);  // 1 x 4 x 2
  EXPECT_NEAR(found.area, 2 * (4 + 8 + 2), 28 * summed);
  ASSERT_TRUE(found.solid);
  EXPECT_NEAR(found.solid->volume, 8, 8 * summed);
  EXPECT_LE((found.solid->centroid - Eigen::Vector3d(3, -1, 7)).norm(), 10 * summed);
  EXPECT_LE((found.area_centroid - Eigen::Vector3d(3, -1, 7)).norm(), 10 * summed);
  const Eigen::Vector3d expected = 8.0 / 12 * Eigen::Vector3d(16 + 4, 1 + 4, 1 + 16);
  EXPECT_LE((found.solid->inertia - Eigen::Matrix3d(expected.asDiagonal())).norm(), 100 * summed);
}

TEST(LimitIntegrals, OfTheBilinearTetrahedronAreThoseOfTheTriangles) {
  const ControlMesh mesh = jittered(tetrahedron());
  const LimitIntegrals found = integrals("bilinear", mesh);
  double volume = 0, area = 0;
  for (Index f = 0; f < 4; ++f) {
    const auto p = [&](int k) { return Eigen::Vector3d(mesh.positions.row(mesh.face_vertices[size_t(3 * f + k)])); };
    volume += p(0).dot(p(1).cross(p(2))) / 6;
    area += (p(1) - p(0)).cross(p(2) - p(0)).norm() / 2;
  }
  EXPECT_NEAR(found.solid->volume, volume, 10 * summed);
  EXPECT_NEAR(found.area, area, 10 * area_accuracy);
}

// One step of refinement makes other parts of the same surface.
TEST(LimitIntegrals, AreTheSameFromEveryLevel) {
  ControlMesh creased = cube();
  add_crease(creased, {0, 1, 3}, {1.5f, 2.25f});
  const std::vector<std::pair<const char*, ControlMesh>> cases{
      {"catmull-clark", creased}, {"catmull-clark", prism(5)}, {"loop", icosahedron()},    {"doo-sabin", prism(5)},
      {"averaging", torus(5, 4)}, {"mid-edge", cube()},        {"catmull-clark", pole(20)}};
  for (const auto& [name, shape] : cases) {
    SCOPED_TRACE(name);
    const ControlMesh mesh = jittered(shape);
    const Scheme<double> scheme = *find_scheme(name);
    const LimitIntegrals coarse = limit_integrals(LimitSurface(scheme, mesh), mesh.positions);
    const auto levels = refine(scheme, mesh, scheme.period);
    const Points fine_points = refinement_matrix(levels) * mesh.positions;
    const LimitIntegrals fine = limit_integrals(LimitSurface(scheme, levels.back()), fine_points);
    ASSERT_TRUE(coarse.solid && fine.solid);
    const double size = coarse.solid->volume;
    EXPECT_NEAR(coarse.solid->volume, fine.solid->volume, 1e-12 * size);
    EXPECT_LE((coarse.solid->centroid - fine.solid->centroid).norm(), 1e-12 * 10);
    EXPECT_LE((coarse.solid->inertia - fine.solid->inertia).norm(), 1e-12 * coarse.solid->inertia.norm());
    EXPECT_NEAR(coarse.area, fine.area, area_accuracy * coarse.area);
  }
}

TEST(LimitIntegrals, MoveWithTheMesh) {
  const ControlMesh mesh = jittered(prism(5));
  const LimitIntegrals before = integrals("catmull-clark", mesh);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d shift(0.5, -2, 1);
  ControlMesh moved = mesh;
  moved.positions = ((2 * mesh.positions * turn.transpose()).rowwise() + shift.transpose()).eval();
  const LimitIntegrals after = integrals("catmull-clark", moved);
  EXPECT_NEAR(after.area, 4 * before.area, area_accuracy * after.area);
  EXPECT_NEAR(after.solid->volume, 8 * before.solid->volume, 1e-12 * after.solid->volume);
  EXPECT_LE((after.solid->centroid - (2 * turn * before.solid->centroid + shift)).norm(), 1e-11);
  EXPECT_LE((after.solid->inertia - 32 * turn * before.solid->inertia * turn.transpose()).norm(),
            1e-12 * after.solid->inertia.norm());
}

// Of triangles within a proved distance: what lies between has at most the area times the distance.
TEST(LimitIntegrals, AreNearThoseOfTriangles) {
  const ControlMesh mesh = jittered(cube());
  const LimitSurface surface(find_scheme("catmull-clark").value(), mesh);
  const LimitIntegrals exact = limit_integrals(surface, mesh.positions);
  for (const double chord : {1e-2, 1e-3}) {
    const Tessellation t = tessellate(surface, mesh.positions, {.chord = chord});
    double volume = 0, area = 0;
    for (const Tessellation::Triangle& triangle : t.triangles) {
      const auto p = [&](size_t k) { return Eigen::Vector3d(t.points.row(triangle.vertices[k])); };
      volume += p(0).dot(p(1).cross(p(2))) / 6;
      area += (p(1) - p(0)).cross(p(2) - p(0)).norm() / 2;
    }
    EXPECT_NEAR(volume, exact.solid->volume, exact.area * chord);
    EXPECT_LE(area, exact.area * (1 + 1e-3));
  }
}

// Where the surface is C^2 but for extraordinary points, its curvature integrates to 2 pi times Euler's number: the
// rule of midpoints is good to the square of the steps on tori, and where curvature is unbounded to some percent.
TEST(LimitIntegrals, CurvatureIntegratesToEulersNumber) {
  const auto total = [](const ControlMesh& mesh, int steps) {
    const LimitSurface surface(find_scheme("catmull-clark").value(), mesh);
    std::vector<Sample> at;
    for (Index f = 0; f < surface.faces().size; ++f)
      for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) at.push_back({f, (i + 0.5) / steps, (j + 0.5) / steps});
    const LimitSamples s = surface.evaluate(mesh.positions, at, 2);
    double sum = 0;
    for (Index i = 0; i < std::ssize(at); ++i) {
      const Eigen::Vector3d u = s.du.row(i), v = s.dv.row(i);
      sum += curvature(s, i)->gauss * u.cross(v).norm() / (steps * steps);
    }
    return sum;
  };
  EXPECT_NEAR(total(torus(8, 6), 40), 0, 0.01);
  EXPECT_NEAR(total(cube(), 80), 4 * std::numbers::pi, 0.03 * 4 * std::numbers::pi);
}

TEST(LimitIntegrals, OpenSurfacesBoundNoSolid) {
  EXPECT_FALSE(integrals("catmull-clark", grid(3, 2)).solid);
  ControlMesh holed = cube();
  holed.holes = {0};
  const LimitIntegrals found = integrals("bilinear", holed);
  EXPECT_FALSE(found.solid);
  EXPECT_NEAR(found.area, 20, 20 * summed);
  const ControlMesh plane = make_mesh({{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}}, {{0, 1, 2, 3}});
  EXPECT_NEAR(integrals("bilinear", plane).area, 6, 6 * area_accuracy);
  ControlMesh nothing;
  nothing.positions = Points::Zero(0, 3);
  EXPECT_EQ(integrals("loop", nothing).area, 0);
}

TEST(LimitIntegrals, RefuseSchemesWithoutPolynomials) {
  EXPECT_THROW(integrals("butterfly", icosahedron()), UnsupportedTopology);
}

}  // namespace
}  // namespace sublimit
