// SPDX-License-Identifier: Apache-2.0
#include "sublimit/schemes/torus_pieces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "sublimit/fit/deviation.h"
#include "sublimit/geometric_schemes.h"
#include "support/expect_error.h"
#include "support/irregular_meshes.h"
#include "support/meshes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
constexpr double pi = std::numbers::pi;
const GeometricSurfaceScheme scheme = *find_geometric_scheme<CurvatureMesh>("torus-pieces");

/// What is promised of planes, spheres, cylinders and tori of size 1: positions, radians, curvatures.
constexpr double reproduced = 1e-10;
/// Of meshes of size 1 that were moved, whose points are rounded before the first level.
constexpr double moved = 1e-12;

/// Outwards; tubes of radius r around a circle of radius R: a sphere if R = 0.
SurfacePoint on_torus(double R, double r, double phi, double t) {
  const Vector3d out(std::cos(phi), std::sin(phi), 0), up = Vector3d::UnitZ();
  const Vector3d normal = std::cos(t) * out + std::sin(t) * up;
  return {R * out + r * normal, normal, -1 / r, -std::cos(t) / (R + r * std::cos(t)),
          -std::sin(t) * out + std::cos(t) * up};
}
SurfacePoint on_torus_near(double R, double r, const Vector3d& x) {
  return on_torus(R, r, std::atan2(x[1], x[0]), std::atan2(x[2], std::hypot(x[0], x[1]) - R));
}
SurfacePoint on_cylinder_near(double r, const Vector3d& x) {
  const double phi = std::atan2(x[1], x[0]);
  const Vector3d out(std::cos(phi), std::sin(phi), 0);
  return {r * out + Vector3d(0, 0, x[2]), out, 0, -1 / r, Vector3d::UnitZ()};
}

using Surface = std::function<SurfacePoint(const Vector3d&)>;

/// The mesh with its vertices moved to the surface; some directions exchanged or reversed, as data have them.
CurvatureMesh data_on(const Surface& surface, const ControlMesh& mesh) {
  CurvatureMesh result;
  result.triangles = mesh.face_vertices;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    SurfacePoint p = surface(mesh.positions.row(v).transpose());
    if (v % 3 == 0) {
      p.direction1 = p.direction2();
      std::swap(p.k1, p.k2);
    }
    if (v % 2 == 0) p.direction1 = -p.direction1;
    result.points.push_back(p);
  }
  return result;
}

/// A grid over [0, 1]^2 with inner points moved aside, cut along random diagonals and mapped to space.
CurvatureMesh data_over(const std::function<SurfacePoint(double, double)>& surface, Index n, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  CurvatureMesh result;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) {
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      const double u = i + (inner ? shift(random) : 0), v = j + (inner ? shift(random) : 0);
      result.points.push_back(surface(u / n, v / n));
      if (i == n || j == n) continue;
      const Index a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      const std::array<Index, 6> cut = random() % 2 ? std::array{a, b, c, a, c, d} : std::array{a, b, d, b, c, d};
      result.triangles.insert(result.triangles.end(), cut.begin(), cut.end());
    }
  return result;
}

void expect_on(const Surface& surface, const CurvatureMesh& mesh, const std::string& what) {
  double position = 0, normal = 0, shape = 0;
  for (const SurfacePoint& p : mesh.points) {
    const SurfacePoint truth = surface(p.position);
    position = std::max(position, (p.position - truth.position).norm());
    normal = std::max(normal, (p.normal - truth.normal).norm());
    shape = std::max(shape, (p.shape() - truth.shape()).norm());
  }
  EXPECT_LT(position, reproduced) << what;
  EXPECT_LT(normal, reproduced) << what;
  EXPECT_LT(shape, reproduced) << what;
}

void expect_reproduced(const Surface& surface, const CurvatureMesh& mesh, const std::string& what, int levels = 4) {
  EXPECT_TRUE(scheme.notes(scheme.checked(mesh)).empty()) << what;
  for (int k = 1; k <= levels; ++k) expect_on(surface, refine(scheme, mesh, k), what + ", level " + std::to_string(k));
}

TEST(TorusPieces, ReproduceTheSphere) {
  const Surface sphere = [](const Vector3d& x) { return on_torus_near(0, 1, x); };
  for (const auto& [name, mesh] : {std::pair("tetrahedron", tetrahedron()), std::pair("octahedron", octahedron()),
                                   std::pair("icosahedron", flipped(icosahedron(), 6))}) {
    CurvatureMesh data = data_on(sphere, mesh);
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (SurfacePoint& p : data.points) {  // any directions are principal
      p.k1 = p.k2 = -1;
      const Vector3d any(normal(random), normal(random), normal(random));
      p.direction1 = p.normal.cross(any).normalized();
    }
    expect_reproduced(sphere, data, name);
  }
}

TEST(TorusPieces, ReproduceTheTorusAtAllLatitudes) {
  for (const double r : {0.3, 0.9}) {
    const Surface torus = [r](const Vector3d& x) { return on_torus_near(1, r, x); };
    CurvatureMesh data = data_on(torus, flipped(triangle_torus(9, 7), 20));
    for (Index v = 0; v < data.num_vertices(); ++v)
      data.points[v] = on_torus(1, r, 2 * pi * (v / 7 + 0.1 * (v % 5)) / 9, 2 * pi * (v % 7 + 0.1 * (v % 4)) / 7);
    expect_reproduced(torus, data, "r " + std::to_string(r));
  }
}

TEST(TorusPieces, ReproduceCylinderAndPlane) {
  const Surface cylinder = [](const Vector3d& x) { return on_cylinder_near(0.5, x); };
  expect_reproduced(cylinder,
                    data_over(
                        [&](double u, double v) {
                          return cylinder({std::cos(4 * u), std::sin(4 * u), v});
                        },
                        5),
                    "cylinder");
  const Surface plane = [](const Vector3d& x) {
    return SurfacePoint{{x[0], x[1], 0}, Vector3d::UnitZ(), 0, 0, Vector3d::UnitX()};
  };
  expect_reproduced(plane, data_over([&](double u, double v) { return plane({u, v, 0}); }, 5), "plane");
}

}  // namespace
}  // namespace sublimit::testing
