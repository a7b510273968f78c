// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/piper.h"

#include <gtest/gtest.h>

#include <cmath>

#include "meshes/normal_triangles.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;

/// Of patches of size 1: some hundred operations.
constexpr double net_rounding = 1e-13, precise_net = 1e-70;
/// Planes along edges: normals are of derivatives, which have cancelled a digit.
constexpr double net_plane = 1e-13, precise_net_plane = 1e-40;
/// Of second derivatives, of size 10.
constexpr double net_second = 1e-11;

/// Control points of the spoke from a corner, and of the strips beside it, from both pieces.
template <class T>
struct Spoke {
  std::array<Eigen::Vector3<T>, 5> points, again;
  std::array<Eigen::Vector3<T>, 4> left, right;
};
template <class T>
Spoke<T> spoke(const std::array<typename PiperPatch<T>::Net, 3>& nets, int corner) {
  const auto &right = nets[corner], &left = nets[(corner + 2) % 3];
  Spoke<T> s;
  for (int k = 0; k <= 4; ++k) {
    s.points[k] = right[quartic_index(0, k)];
    s.again[k] = left[quartic_index(4 - k, k)];
    if (k == 4) break;
    s.right[k] = right[quartic_index(1, k)];
    s.left[k] = left[quartic_index(3 - k, k)];
  }
  return s;
}

TEST(Piper, GoesThroughPointsWithNormalsAlongEdgeCubics) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto corners = random_corners(seed);
    expect_interpolation<PiperPatch>(triangle<double>(corners), net_rounding);
    if (seed < 3) expect_interpolation<PiperPatch>(triangle<Precise>(corners), precise_net);
  }
}

TEST(Piper, NeighboursTouchTheSamePlanes) {
  for (unsigned seed = 0; seed < 10; ++seed) expect_common_planes<PiperPatch, double>(random_corners(seed), net_plane);
  for (unsigned seed = 0; seed < 2; ++seed)
    expect_common_planes<PiperPatch, Precise>(random_corners(seed), precise_net_plane);
}

// Every pair of small triangles across a spoke is an affine image of the domain's, whose centre is a mean.
template <class T>
void expect_smooth_spokes(unsigned seed, double tolerance) {
  const auto nets = patch_of<PiperPatch>(triangle<T>(random_corners(seed))).control_points();
  for (int corner = 0; corner < 3; ++corner) {
    const Spoke<T> s = spoke<T>(nets, corner);
    EXPECT_EQ(s.points, s.again);
    for (int k = 0; k < 4; ++k)
      EXPECT_LE(double((s.points[k] + s.left[k] + s.right[k] - s.points[k + 1] * T(3)).norm()), tolerance);
    const Eigen::Vector3<T> fourth =
        s.points[0] - s.points[1] * T(4) + s.points[2] * T(6) - s.points[3] * T(4) + s.points[4];
    EXPECT_LE(double(fourth.norm()), tolerance) << "spokes are cubics";
  }
}
TEST(Piper, PiecesMeetC1AlongCubics) {
  for (unsigned seed = 0; seed < 10; ++seed) expect_smooth_spokes<double>(seed, net_rounding);
  expect_smooth_spokes<Precise>(1, precise_net);
}

TEST(Piper, IsItsControlPoints) {
  const PiperPatch<double> patch = patch_of<PiperPatch>(triangle<double>(random_corners(6)));
  const auto nets = patch.control_points();
  constexpr double factorial[] = {1, 1, 2, 6, 24};
  for (int m = 0; m < 3; ++m)
    for (int x = 0; x <= 6; ++x)
      for (int y = 0; x + y <= 6; ++y) {
        const double a = x / 6.0, b = y / 6.0, c = 1 - a - b;  // of corners m, m + 1 and the centre
        Vector3d sum = Vector3d::Zero();
        for (int k = 0; k <= 4; ++k)
          for (int j = 0; j + k <= 4; ++j)
            sum += 24 / (factorial[4 - j - k] * factorial[j] * factorial[k]) * std::pow(a, 4 - j - k) * std::pow(b, j) *
                   std::pow(c, k) * nets[m][quartic_index(j, k)];
        std::array<double, 3> place{c / 3, c / 3, c / 3};
        place[m] += a;
        place[(m + 1) % 3] += b;
        EXPECT_LE((patch.at(place[1], place[2], 0).position - sum).norm(), net_rounding) << m << " " << x << " " << y;
      }
}

TEST(Piper, DerivativesAreThoseOfPositions) {
  for (unsigned seed = 0; seed < 3; ++seed)  // one place in each piece and more
    expect_true_derivatives<PiperPatch>(triangle<Precise>(random_corners(seed)),
                                        {{0.3, 0.2}, {0.45, 0.5}, {0.1, 0.3}, {0.05, 0.9}, {0.5, 0.125}});
}

TEST(Piper, DoublesAreAsGoodAs256Bits) {
  for (unsigned seed = 0; seed < 5; ++seed)
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; i + j <= 8; ++j)
        expect_precise_values<PiperPatch>(random_corners(seed), i / 8.0, j / 8.0, net_rounding, net_second);
}

TEST(Piper, MovesWithItsData) {
  for (unsigned seed = 0; seed < 10; ++seed) expect_no_preference<PiperPatch>(random_corners(seed), net_rounding);
}

TEST(Piper, PlanesArePlane) { expect_plane<PiperPatch>(random_corners(1)); }

TEST(Piper, IsNearSpheres) {
  const Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const auto middle = [](const Vector3d& a, const Vector3d& b) { return Vector3d((a + b).normalized()); };
  constexpr double two_digits = 2e-4;  // of each figure
  constexpr double last_digit = 5e-6;
  EXPECT_NEAR(distance_from_sphere<PiperPatch>(on_sphere(x, y, z)), 3.3e-2, two_digits);
  // Quarters of the octant: two edges of 45 degrees and one of 60, three of 60.
  EXPECT_NEAR(distance_from_sphere<PiperPatch>(on_sphere(x, middle(x, y), middle(x, z))), 8.9e-4, last_digit);
  EXPECT_NEAR(distance_from_sphere<PiperPatch>(on_sphere(middle(x, y), middle(y, z), middle(z, x))), 2.61e-3,
              last_digit);
}

TEST(Piper, StatusSaysWhatThereIs) {
  const PiperPatch<double> patch = patch_of<PiperPatch>(triangle<double>(random_corners(4)));
  EXPECT_EQ(patch.at(0.25, 0.125).status, LimitStatus::regular);
  EXPECT_EQ(patch.at(0.25, 0.125).order, 2);
  // Spokes: points with two least coordinates that are equal, or nearly so by rounding.
  for (const auto& [u, v] : {std::pair(0.25, 0.25), std::pair(0.6, 0.2), std::pair(0.1, 0.8)}) {
    EXPECT_EQ(patch.at(u, v).status, LimitStatus::crease) << u << " " << v;
    EXPECT_EQ(patch.at(u, v).order, 2);
    EXPECT_EQ(patch.at(u, v, 1).status, LimitStatus::regular);
    // Across them positions and first derivatives go on, second ones jump.
    const double r = 1e-9, du = u == v ? r : v == 0.2 ? 0 : -r, dv = u == v ? -r : v == 0.2 ? r : 0;
    const PatchPoint<double> a = patch.at(u + du, v + dv), b = patch.at(u - du, v - dv);
    EXPECT_LE((a.du - b.du).norm() + (a.dv - b.dv).norm(), 100 * r);
    EXPECT_GT((a.duu - b.duu).norm() + (a.duv - b.duv).norm() + (a.dvv - b.dvv).norm(), 1e-3);
  }
  // At the centre all pieces have the same second derivatives.
  const double third = 1.0 / 3;
  const PatchPoint<double> centre = patch.at(third, third);
  EXPECT_EQ(centre.status, LimitStatus::regular);
  constexpr double of_the_step = 1e-6;  // third derivatives, of size 100, times a step of 2e-9
  for (const auto& [du, dv] : {std::pair(1e-9, 1e-9), std::pair(-2e-9, 1e-9), std::pair(1e-9, -2e-9)}) {
    const PatchPoint<double> a = patch.at(third + du, third + dv);
    EXPECT_LE((a.duu - centre.duu).norm() + (a.duv - centre.duv).norm() + (a.dvv - centre.dvv).norm(), of_the_step);
  }
  for (const auto& [u, v] : {std::pair(0.5, 0.0), std::pair(0.0, 0.25), std::pair(0.3, 0.7), std::pair(1.0, 0.0)}) {
    EXPECT_EQ(patch.at(u, v, 1).status, LimitStatus::crease);
    EXPECT_EQ(patch.at(u, v).order, 2);
    EXPECT_EQ(patch.at(u, v, 0).status, LimitStatus::regular);
  }
}

}  // namespace
}  // namespace sublimit::testing
