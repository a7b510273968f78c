// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/detail/distance_bound.h"

#include <gtest/gtest.h>

#include <random>

#include "meshes/hard_meshes.h"
#include "meshes/meshes.h"
#include "sublimit/parts/parted_surface.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/search/closest_point.h"
#include "sublimit/search/detail/net_distance.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

using namespace testing;

Points random_points(const Mesh& mesh, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::RowVector3d middle = mesh.positions.colwise().mean();
  const double size = (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
  Points q(count, 3);
  for (Eigen::Index i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k) q(i, k) = middle[k] + 0.5 * size * normal(random);
  return q;
}

// The bound is told a distance that is too large, so it cannot lean on the right one: it has to find a nearer place, or
// to stay below.
TEST(DistanceBound, IsNeverAboveTheDistance) {
  for (const char* name : {"bilinear", "catmull-clark", "loop", "doo-sabin", "averaging"}) {
    const Scheme<double> scheme = *find_scheme<double>(name);
    for (const Mesh& mesh : hard_meshes(scheme, 3)) {
      const LimitMap surface(scheme, mesh);
      const DistanceBound bound(PartedLimit(surface, mesh.positions));
      const Points q = random_points(mesh, 20, 3);
      const Eigen::VectorXd distances = closest(surface, mesh.positions, q, {.prove = false}).distances;
      PieceParts cutter;
      for (Eigen::Index i = 0; i < q.rows(); ++i)
        for (const double factor : {1 + 1e-9, 1.01, 3.0})
          for (const int most : {1, 10, 100, 2000}) {
            const double told = factor * distances[i];
            const ProvedDistance proved = bound(q.row(i), told, most, cutter);
            if (proved.closer)
              EXPECT_LT((surface.evaluate(mesh.positions, {&*proved.closer, 1}).position.row(0) - q.row(i)).norm(),
                        told)
                  << name;
            else
              EXPECT_LE(proved.lower, distances[i] * (1 + found_distance)) << name << " " << factor << " " << most;
          }
    }
  }
}

// Far from the origin coordinates have fewer digits than the surface needs: bounds give way by as much, and no more.
TEST(DistanceBound, HoldsFarFromTheOrigin) {
  const Mesh mesh = cube();
  const Scheme<double> scheme = *find_scheme<double>("catmull-clark");
  for (const double offset : {0.0, 1e2, 1e4, 1e6, 1e8}) {
    Mesh moved = mesh;
    moved.positions.array() += offset;
    const Points q = random_points(mesh, 500, 6).array() + offset;
    const ClosestPoints found = closest(LimitMap(scheme, moved), moved.positions, q);
    // Back again: differences of near numbers are exact.
    const Points back = q.array() - offset;
    const Eigen::VectorXd exact = closest(LimitMap(scheme, mesh), mesh.positions, back).distances;
    const double digits = 1e-14 * (4 + offset);
    for (Eigen::Index i = 0; i < q.rows(); ++i) {
      EXPECT_LE(found.lower[i], exact[i] + rounding(4)) << offset << " " << i;
      EXPECT_GE(found.lower[i], exact[i] - 4e-12 - 100 * digits) << offset << " " << i;
    }
  }
}

// Where hulls are estimated nothing is proved.
TEST(DistanceBound, ProvesNothingByEstimates) {
  const Mesh mesh = octahedron();
  const LimitMap surface(*find_scheme<double>("butterfly"), mesh);
  const ClosestPoints found = closest(surface, mesh.positions, random_points(mesh, 3, 7));
  EXPECT_EQ(found.lower.maxCoeff(), 0);
}

TEST(DistanceBound, FindsWhatIsNearer) {
  const Scheme<double> scheme = *find_scheme<double>("catmull-clark");
  const Mesh mesh = torus(7, 5);
  const LimitMap surface(scheme, mesh);
  const DistanceBound bound(PartedLimit(surface, mesh.positions));
  PieceParts cutter;
  const Points q = random_points(mesh, 50, 4);
  const Eigen::VectorXd distances = closest(surface, mesh.positions, q).distances;
  for (Eigen::Index i = 0; i < q.rows(); ++i)
    EXPECT_TRUE(bound(q.row(i), 1.5 * distances[i] + 1e-3, 2000, cutter).closer) << i;
}

// A paraboloid x = (u, v, u^2 + v^2) below a point: the foot is at the corner, the middle, or nothing is convex beyond
// the centre of curvature (0, 0, 1/2).
TEST(NetDistance, KnowsWhereADistanceIsConvex) {
  const PolynomialBasis basis(2, false);
  Points net(9, 3);
  const double low = -0.1, high = 0.1;  // the square [low, high]^2
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const auto linear = [&](int k) { return low + (high - low) * k / 2; };
      const auto square = [&](int k) { return k == 0 ? low * low : k == 1 ? low * high : high * high; };
      net.row(net_row(basis, i, j)) << linear(i), linear(j), square(i) + square(j);
    }
  const NetDistance near_one(basis, net, {0, 0, 0.2}, rounding(10));
  const auto found = near_one.convex_minimum(0);
  ASSERT_TRUE(found);
  constexpr double slack = 2e-14;  // given to the net for rounding, and used up
  EXPECT_NEAR(found->lower, 0.2, slack);
  EXPECT_NEAR(found->at, 0.2, rounding(4));
  EXPECT_NEAR(found->uv[0], 0.5, std::sqrt(eps));
  EXPECT_FALSE(
      NetDistance(basis, net, {0, 0, 0.6}, rounding(10)).convex_minimum(0));  // the foot is a saddle or a maximum there
  const auto corner = NetDistance(basis, net, {1, 1, 0}, rounding(10)).convex_minimum(0);
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->at, std::sqrt(2 * 0.81 + 0.02 * 0.02), rounding(10));
  EXPECT_NEAR(corner->lower, corner->at, slack);
  EXPECT_LE(near_one.lower({0, 0, -1}), 0.2);
  EXPECT_NEAR(NetDistance(basis, net, {0, 0, -3}, 0).lower({0, 0, 1}), 3 - 0.02,
              rounding(10));  // the middle coefficient
}

}  // namespace
}  // namespace sublimit
