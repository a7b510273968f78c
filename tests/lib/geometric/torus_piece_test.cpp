// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/torus_piece.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "lib/geometric/torus_patch.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
/// Differences over steps of 1e-4 of curves bent by up to 3: the step's square, and rounding by it.
constexpr double step = 1e-4, first_difference = 1e-6, second_difference = 1e-6;
const double arcs = rounding(16);

struct Named {
  const char* name;
  TorusPiece piece;
};
TorusPiece piece(double k1, double k2, double g) {
  const Vector3d n = Vector3d(1, 2, 2) / 3, e1 = Vector3d(2, 1, -2) / 3;
  return {{0.5, -1, 2}, e1, n, k1, k2, g};
}
std::vector<Named> all_kinds() {
  return {{"plane", piece(0, 0, 0)},
          {"plane in circles", piece(0, 0, 0.3)},
          {"cylinder along the tube", piece(0, 0.8, 0)},
          {"cylinder around", piece(-0.8, 0, 0)},
          {"cone-like, tube straight", piece(0, 0.7, 0.4)},
          {"sphere", piece(0.6, 0.6, 0)},
          {"sphere in small circles", piece(-0.6, -0.6, 0.4)},
          {"outer equator", piece(1.5, 0.4, 0)},
          {"inner equator", piece(-1.5, 0.4, 0)},
          {"top circle", piece(-1.5, 0, 0.4)},
          {"any latitude", piece(1.2, 0.5, -0.4)}};
}

TEST(TorusPiece, FramesAreDerivatives) {
  for (const auto& [name, surface] : all_kinds())
    for (const auto& [u, v] : {std::pair(0.0, 0.0), std::pair(0.3, 0.4), std::pair(-0.5, 0.2)}) {
      const TorusPiece::Frame at = surface.at(u, v), left = surface.at(u - step, v), right = surface.at(u + step, v),
                              down = surface.at(u, v - step), up = surface.at(u, v + step);
      EXPECT_NEAR(at.n.dot(at.e1), 0, arcs) << name;
      EXPECT_NEAR((at.n.cross(at.e1) - at.e2).norm(), 0, arcs) << name;
      EXPECT_NEAR(((right.position - left.position) / (2 * step) - at.e1).norm(), 0, first_difference) << name;
      EXPECT_NEAR(((up.position - down.position) / (2 * step) - at.speed * at.e2).norm(), 0, first_difference) << name;
      // The normal turns against the principal directions.
      EXPECT_NEAR(((right.n - left.n) / (2 * step) + at.k1 * at.e1).norm(), 0, second_difference) << name;
      EXPECT_NEAR(((up.n - down.n) / (2 * step) + at.k2 * at.speed * at.e2).norm(), 0, second_difference) << name;
    }
}

TEST(TorusPiece, FootFindsThePlaceAgain) {
  for (const auto& [name, surface] : all_kinds())
    for (const double u : {-0.4, 0.0, 0.7})
      for (const double v : {-0.6, 0.0, 0.5})
        for (const double w : {-0.2, 0.0, 0.1}) {
          const TorusPiece::Frame at = surface.at(u, v);
          const TorusPiece::Coordinates place = surface.foot(at.position + w * at.n);
          EXPECT_NEAR(place.u, u, arcs) << name;
          EXPECT_NEAR(place.v, v, 2 * arcs) << name;
          EXPECT_NEAR(place.w, w, arcs) << name;
        }
}

TEST(TorusPiece, DoesNotJumpWhereCurvaturesVanish) {
  for (const auto& [name, surface] : all_kinds()) {
    const double tiny = 1e-14;  // of size 1 from the exact one, and nothing amplifies it
    const SurfacePoint at = surface.at(0, 0).point();
    const TorusPiece near(at.position, at.direction1, at.normal, at.k1 + tiny, at.k2 - tiny, surface.geodesic() + tiny);
    const TorusPiece::Frame a = surface.at(0.7, -0.6), b = near.at(0.7, -0.6);
    EXPECT_LT((a.position - b.position).norm() + (a.n - b.n).norm() + (a.e1 - b.e1).norm(), 10 * tiny) << name;
    const TorusPiece::Coordinates p = surface.foot(a.position), q = near.foot(a.position);
    EXPECT_LT(std::abs(p.u - q.u) + std::abs(p.v - q.v) + std::abs(p.w - q.w), 10 * tiny) << name;
  }
}

/// The torus around the z axis, R = 2, r = 1/2: at latitude t its circle around has g = -sin t/(R + r cos t).
TEST(TorusPiece, IsTheTorusAtAnyLatitude) {
  for (const double t : {0.0, 1.0, pi / 2, 2.5, pi, -0.8}) {
    const double R = 2, r = 0.5, rho = R + r * std::cos(t);
    const Vector3d normal(std::cos(t), 0, std::sin(t)), up(-std::sin(t), 0, std::cos(t));
    const TorusPiece surface(Vector3d(R, 0, 0) + r * normal, up, normal, -1 / r, -std::cos(t) / rho, std::sin(t) / rho);
    for (const double u : {-0.7, 0.4})
      for (const double v : {-1.0, 0.3}) {
        const Vector3d x = surface.at(u, v).position;
        EXPECT_NEAR(std::hypot(std::hypot(x[0], x[1]) - R, x[2]), r, arcs) << t;
      }
  }
}

TEST(TorusPatch, LiesOnThePieceAndHasItsMiddle) {
  for (const auto& [name, surface] : all_kinds()) {
    const TorusPiece::Coordinates centre{0.2, -0.3, 0};
    const double half_u = 0.5, half_v = 0.4;
    const RationalPatch patch = torus_patch(surface, centre, half_u, half_v);
    EXPECT_LT((patch.at(0.5, 0.5) - surface.at(0.2, -0.3).position).norm(), arcs) << name;
    EXPECT_LT((patch.at(0, 1) - surface.at(0.2 - half_u, -0.3 + half_v).position).norm(), arcs) << name;
    for (const double s : {0.0, 0.3, 0.9})
      for (const double t : {0.1, 0.5, 1.0}) {
        const TorusPiece::Coordinates place = surface.foot(patch.at(s, t));
        EXPECT_NEAR(place.w, 0, arcs) << name;
        EXPECT_LE(std::abs(place.u - centre.u), half_u + arcs) << name;
        EXPECT_LE(std::abs(place.v - centre.v), half_v + arcs) << name;
      }
  }
}

}  // namespace
}  // namespace sublimit::testing
