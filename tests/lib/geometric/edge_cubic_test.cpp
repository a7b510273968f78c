// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/edge_cubic.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "meshes/normal_triangles.h"
#include "sublimit/geometric/parameter_jet.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

/// The cubic along an arc of the unit circle.
EdgeCubic<double> arc(double angle) {
  const Vector3d a(1, 0, 0), b(std::cos(angle), std::sin(angle), 0);
  return edge_cubic<double>(a, a, b, b);
}
double error_of_radius(const EdgeCubic<double>& edge) {
  double most = 0;
  for (int i = 0; i <= 1000; ++i) most = std::max(most, std::abs(edge.at(1 - i / 1000.0, i / 1000.0).norm() - 1));
  return most;
}

TEST(EdgeCubic, HasEndsAndTangentsInTheirPlanes) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto corners = random_corners(seed);
    const EdgeCubic<double> e =
        edge_cubic<double>(corners[0].point, corners[0].normal, corners[1].point, corners[1].normal);
    EXPECT_EQ(e.at(1, 0), corners[0].point);
    EXPECT_EQ(e.at(0, 1), corners[1].point);
    EXPECT_EQ(e.derivative(1, 0), e.tangent_a);
    EXPECT_EQ(e.derivative(0, 1), e.tangent_b);
    EXPECT_LE(std::abs(e.tangent_a.dot(corners[0].normal)), rounding(4));
    EXPECT_LE(std::abs(e.tangent_b.dot(corners[1].normal)), rounding(4));
    // Along the projection of the chord: chord, normal and tangent are in one plane, on one side.
    const Vector3d chord = e.b - e.a;
    EXPECT_LE(std::abs(chord.cross(corners[0].normal).dot(e.tangent_a)), rounding(8));
    EXPECT_GT(chord.dot(e.tangent_a), 0);
  }
}

TEST(EdgeCubic, IsTheSameFromBothEnds) {
  const auto corners = random_corners(7);
  const EdgeCubic<double> e =
      edge_cubic<double>(corners[0].point, corners[0].normal, corners[1].point, corners[1].normal);
  const EdgeCubic<double> back =
      edge_cubic<double>(corners[1].point, corners[1].normal, corners[0].point, corners[0].normal);
  for (const double s : {0.0, 0.125, 0.5, 0.75, 1.0}) {
    EXPECT_LE((e.at(1 - s, s) - back.at(s, 1 - s)).norm(), rounding(8));
    EXPECT_LE((e.derivative(1 - s, s) + back.derivative(s, 1 - s)).norm(), rounding(16));
  }
}

TEST(EdgeCubic, FollowsCircles) {
  for (const double angle : {0.1, 1.0, pi / 2, 3.0}) {
    const EdgeCubic<double> e = arc(angle);
    EXPECT_NEAR(e.tangent_a.norm(), 4 * std::tan(angle / 4), rounding(8, 10));
    EXPECT_NEAR(e.tangent_a.x(), 0, rounding(8, 10));
  }
  // Known with two digits: half of the last one, and somewhat more where it is cut off.
  constexpr double of_quarter = 5e-6, of_eighth = 1e-7, of_chord = 1e-3;
  EXPECT_NEAR(error_of_radius(arc(pi / 2)), 2.7e-4, of_quarter);
  EXPECT_NEAR(error_of_radius(arc(pi / 4)), 4.2e-6, of_eighth);
  // With tangents as long as the chord it would be much more.
  EdgeCubic<double> plain = arc(pi / 2);
  for (Vector3d* tangent : {&plain.tangent_a, &plain.tangent_b}) *tangent *= std::sqrt(2.0) / tangent->norm();
  EXPECT_NEAR(error_of_radius(plain), 4.3e-2, of_chord);
}

TEST(EdgeCubic, IsItsBezierPoints) {
  const auto corners = random_corners(3);
  const EdgeCubic<double> e =
      edge_cubic<double>(corners[0].point, corners[0].normal, corners[1].point, corners[1].normal);
  const auto c = e.control_points();
  for (const double t : {0.25, 0.5, 0.875}) {
    const double s = 1 - t;
    EXPECT_LE((e.at(s, t) - (s * s * s * c[0] + 3 * s * s * t * c[1] + 3 * s * t * t * c[2] + t * t * t * c[3])).norm(),
              rounding(8));
  }
}

TEST(EdgeCubic, HasNoTangentAlongItsNormal) {
  const Vector3d z(0, 0, 1);
  EXPECT_FALSE(edge_tangent<double>(2 * z, z).allFinite());
  EXPECT_FALSE(edge_tangent<double>(Vector3d::Zero(), z).allFinite());
}

// Every operation at once, against derivatives by hand: f = sqrt(u) / (u v + 2) - v.
TEST(Jet, HasDerivativesOfFormulas) {
  using J = Jet<double>;
  const double u = 2.25, v = 0.5, r = std::sqrt(u), w = u * v + 2;
  const J x(u, 1, 0), y(v, 0, 1);
  J f = sqrt(x) / (x * y + 2);
  f -= y;
  EXPECT_NEAR(f.value, r / w - v, rounding(4));
  EXPECT_NEAR(f.u, 0.5 / (r * w) - r * v / (w * w), rounding(8));
  EXPECT_NEAR(f.v, -r * u / (w * w) - 1, rounding(8));
  EXPECT_NEAR(f.uu, -0.25 / (r * u * w) - v / (r * w * w) + 2 * r * v * v / (w * w * w), rounding(16));
  EXPECT_NEAR(f.uv, -0.5 * u / (r * w * w) - r / (w * w) + 2 * r * u * v / (w * w * w), rounding(16));
  EXPECT_NEAR(f.vv, 2 * r * u * u / (w * w * w), rounding(16));
}

// The formulas of derivatives that are written out agree with jets.
TEST(EdgeCubic, DerivativeIsThatOfItsFormula) {
  const auto corners = random_corners(5);
  const EdgeCubic<double> e =
      edge_cubic<double>(corners[0].point, corners[0].normal, corners[1].point, corners[1].normal);
  for (const double t : {0.0, 0.25, 0.7, 1.0}) {
    const Eigen::Vector3<Jet<double>> x = e.cast<Jet<double>>().at(Jet<double>(1 - t, -1, 0), Jet<double>(t, 1, 0));
    const Vector3d derivative = e.derivative(1 - t, t);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(x[c].u, derivative[c], rounding(16));
  }
}

}  // namespace
}  // namespace sublimit::testing
