// SPDX-License-Identifier: Apache-2.0
// Regular nets, where the surface is known in closed form: linear functions of the parameter, and quadratic ones with
// their curvature.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <random>

#include "laws/tested_schemes.h"
#include "sublimit/source/curvature.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

constexpr Index side = 12;

/// A place in the plane of the net, x along the first axis of its faces, and its parameters there.
struct InPlane {
  Eigen::Vector2d at, by_u, by_v;
};

/// Of a grid whose vertex (i,j) has number j (side + 1) + i and stands at (i,j).
InPlane in_plane(const LimitMap& surface, const Place& s) {
  const Topology& t = surface.level().topology();
  const auto corners = t.vertices(surface.addresses().place(s.face).face);
  const auto place = [](Index v) { return Eigen::Vector2d(v % (side + 1), v / (side + 1)); };
  const Eigen::Vector2d origin = place(corners[0]), u = place(corners[1]) - origin, v = place(corners.back()) - origin;
  return {origin + s.u * u + s.v * v, u, v};
}

Mesh net(bool triangles, const std::function<Eigen::Vector3d(double, double)>& point) {
  Mesh mesh = triangles ? triangle_grid(side, side) : grid(side, side);
  for (Index v = 0; v < mesh.num_vertices(); ++v)
    mesh.positions.row(v) = point(v % (side + 1), v / (side + 1)).transpose();
  return mesh;
}

class RegularNets : public ::testing::TestWithParam<TestedScheme> {};

/// Inside by all schemes that reproduce lines (the only ones here), up to the border by those whose border curve has
/// that parameter.
TEST_P(RegularNets, LinearFunctionsOfTheParameterAreReproduced) {
  const Scheme<double> scheme = GetParam().scheme();
  const Eigen::Vector3d a(1, -0.25, 2), b(0.5, 1, 1), c(3, 2, 1);
  const Mesh mesh =
      net(takes_triangles(scheme), [&](double i, double j) { return Eigen::Vector3d(c + i * a + j * b); });
  const LimitMap surface(scheme, mesh);
  const double depth = scheme.name == "bilinear" || scheme.name == "catmull-clark" || scheme.name == "loop" ||
                               scheme.name.starts_with("doo-sabin")
                           ? 0
                           : 4.75;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  int compared = 0;
  for (int i = 0; i < 6000 && compared < 150 / effort(scheme); ++i) {
    Place s{Index(random() % std::uint32_t(surface.addresses().size())), unit(random), unit(random)};
    if (random() % 4 == 0) s.u = double(random() % 9) / 8;
    if (random() % 4 == 0) s.v = double(random() % 9) / 8;
    if (surface.addresses().triangles() && s.u + s.v > 1) s.u = 1 - s.u, s.v = 1 - s.v;
    const InPlane p = in_plane(surface, s);
    if (p.at.minCoeff() < depth || p.at.maxCoeff() > side - depth) continue;
    // The net's corners are rounded off, or irregular.
    const bool in_corner = (p.at.array() - side / 2.0).abs().minCoeff() > side / 2.0 - 1;
    if ((scheme.is_dual() || takes_triangles(scheme)) && in_corner) continue;
    ++compared;
    SCOPED_TRACE("at " + std::to_string(p.at[0]) + ", " + std::to_string(p.at[1]));
    const LimitSamples found = surface.evaluate(mesh.positions, std::span(&s, 1), 1);
    const Eigen::Vector3d x = c + p.at[0] * a + p.at[1] * b;
    EXPECT_LE((Eigen::Vector3d(found.position.row(0)) - x).norm(), eigen() * x.norm());
    if (scheme.claims.regular == 0) continue;
    ASSERT_GE(found.order[0], 1);
    const double size = a.norm() + b.norm();
    EXPECT_LE((Eigen::Vector3d(found.du.row(0)) - (p.by_u[0] * a + p.by_u[1] * b)).norm(), eigen(100) * size);
    EXPECT_LE((Eigen::Vector3d(found.dv.row(0)) - (p.by_v[0] * a + p.by_v[1] * b)).norm(), eigen(100) * size);
    EXPECT_LE((Eigen::Vector3d(found.normal.row(0)) - a.cross(b).normalized()).norm(), reference_angle);
  }
  EXPECT_GE(compared, 30 / effort(scheme));
}

INSTANTIATE_TEST_SUITE_P(Schemes, RegularNets,
                         ::testing::ValuesIn(schemes_and_degrees_if([](const Scheme<double>& scheme) {
                           return scheme.claims.reproduces >= 1;
                         })),
                         test_name);

/// z = (k x^2 + 2 m x y + l y^2)/2 over a sheared plane net. Cubic B-splines of the values i^2 - 1/3 are the square.
struct Quadratic {
  double k, m, l;
  double height(double x, double y) const { return (k * x * x + 2 * m * x * y + l * y * y) / 2; }
};

TEST(LimitSurfaceCurvature, IsThatOfQuadrics) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  const double shear = 0.375;  // x = i + shear j, y = j
  const double half = side / 2;
  for (const Quadratic& q : {Quadratic{0.5, 0, 0.5}, {0.5, 0, -0.5}, {0.5, 0, 0}, {0.25, 0.125, -0.75}, {0, 0, 0}}) {
    const Mesh mesh = net(false, [&](double i, double j) {
      const double x = i - half + shear * (j - half), y = j - half;
      // Squares of x and y and their product, less a third of what they are of unit steps in i and j.
      const double less = (q.height(1, 0) + q.height(shear, 1)) / 3;
      return Eigen::Vector3d(x, y, q.height(x, y) - less);
    });
    const LimitMap surface(scheme, mesh);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Place> samples;
    while (samples.size() < 1000) {
      const Place s{Index(random() % std::uint32_t(surface.addresses().size())), unit(random), unit(random)};
      const InPlane p = in_plane(surface, s);
      if (p.at.minCoeff() > 1 && p.at.maxCoeff() < side - 1) samples.push_back(s);
    }
    for (const size_t count : {size_t(50), samples.size()}) {
      const LimitSamples found = surface.evaluate(mesh.positions, std::span(samples).first(count), 2);
      for (Index i = 0; i < 50; ++i) {
        const double x = found.position(i, 0), y = found.position(i, 1);
        EXPECT_LE(std::abs(found.position(i, 2) - q.height(x, y)), rounding(256, 16));
        const double fx = q.k * x + q.m * y, fy = q.m * x + q.l * y, w = 1 + fx * fx + fy * fy;
        const double gauss = (q.k * q.l - q.m * q.m) / (w * w);
        const double mean = ((1 + fx * fx) * q.l - 2 * fx * fy * q.m + (1 + fy * fy) * q.k) / (2 * w * std::sqrt(w));
        const std::optional<Curvature> c = curvature(found, i);
        ASSERT_TRUE(c);
        const double tolerance = eigen(10);
        EXPECT_LE(std::abs(c->gauss - gauss), tolerance);
        EXPECT_LE(std::abs(c->mean - mean), tolerance);  // towards +z, as the normal
        EXPECT_GE(c->k1, c->k2);
        EXPECT_LE(std::abs(c->k1 * c->k2 - gauss), tolerance);
        EXPECT_LE(std::abs(c->k1 + c->k2 - 2 * mean), tolerance);
        const Eigen::Vector3d normal = found.normal.row(i);
        EXPECT_LE((normal - Eigen::Vector3d(-fx, -fy, 1).normalized()).norm(), reference_angle);
        for (const auto& [direction, k] : {std::pair(c->direction1, c->k1), {c->direction2, c->k2}}) {
          EXPECT_LE(std::abs(direction.norm() - 1), rounding(16));
          EXPECT_LE(std::abs(direction.dot(normal)), eigen(10));
          // The normal curvature of a graph in a tangent direction (a, b, .): its second form by its first.
          const double a = direction[0], b = direction[1];
          EXPECT_LE(std::abs((q.k * a * a + 2 * q.m * a * b + q.l * b * b) / std::sqrt(w) - k), tolerance);
        }
        EXPECT_LE(std::abs(c->direction1.dot(c->direction2)), rounding(16));
      }
    }
  }
}

TEST(LimitSurfaceCurvature, IsAbsentWithoutSecondDerivatives) {
  const LimitMap surface(find_scheme("catmull-clark").value(), cube());
  const LimitSamples samples = surface.evaluate(cube().positions, std::vector<Place>{{0, 0, 0}, {0, 0.25, 0.25}}, 2);
  EXPECT_FALSE(curvature(samples, 0));  // extraordinary
  EXPECT_TRUE(curvature(samples, 1));
  EXPECT_FALSE(curvature(surface.evaluate(cube().positions, std::vector<Place>{{0, 0.25, 0.25}}, 1), 0));
  Mesh line = grid(4, 4);
  line.positions.rightCols(2).setZero();
  const LimitMap degenerate(find_scheme("catmull-clark").value(), line);
  EXPECT_FALSE(curvature(degenerate.evaluate(line.positions, std::vector<Place>{{5, 0.25, 0.25}}, 2), 0));
}

}  // namespace
}  // namespace sublimit::testing
