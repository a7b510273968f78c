// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/hermite.h"

#include <gtest/gtest.h>

#include "meshes/construction_data.h"
#include "sublimit/patches/constructions/coons.h"
#include "sublimit/patches/constructions/polynomial_curves.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

TEST(HermitePatch, HasItsVectorsAtTheCorners) {
  std::mt19937 random(1);
  const Points data = random_points(random, 16, 3);
  for (const HermiteVectors vectors : {HermiteVectors::twelve, HermiteVectors::sixteen, HermiteVectors::adini}) {
    const SplineNet net = hermite_patch(vectors, data.topRows(vectors == HermiteVectors::sixteen ? 16 : 12));
    for (Index corner = 0; corner < 4; ++corner) {
      const Index a = corner % 2, b = corner / 2;
      const OwnValues at = own_values(net, double(a), double(b));
      expect_near(at.x.row(0), data.row(corner), sums);
      expect_near(at.x.row(1), data.row(4 + corner), sums);
      expect_near(at.x.row(2), data.row(8 + corner), sums);
      Eigen::RowVector3d twist = Eigen::RowVector3d::Zero();
      if (vectors == HermiteVectors::sixteen) twist = data.row(12 + corner);
      if (vectors == HermiteVectors::adini)
        twist = data.row(4 + a + 2) - data.row(4 + a) + data.row(8 + 1 + 2 * b) - data.row(8 + 2 * b) -
                (data.row(0) - data.row(1) - data.row(2) + data.row(3));
      expect_near(at.x.row(4), twist, derivative_sums);
    }
  }
}

/// The four boundary cubics.
CoonsBoundary boundary_cubics(const Points& data) {
  const auto cubic = [&](Index from, Index to, Index tangents) {
    Points ends(2, 3), slopes(2, 3);
    ends << data.row(from), data.row(to);
    slopes << data.row(tangents + from), data.row(tangents + to);
    return hermite_curve(ends, slopes);
  };
  return {cubic(0, 1, 4), cubic(2, 3, 4), cubic(0, 2, 8), cubic(1, 3, 8)};
}

TEST(HermitePatch, OfTwelveVectorsIsTheBicubicCoonsPatch) {
  std::mt19937 random(2);
  const Points data = random_points(random, 12, 3);
  expect_near(hermite_patch(HermiteVectors::twelve, data).columns,
              coons(boundary_cubics(data), CoonsBlending::bicubic).columns, sums);
}

TEST(HermitePatch, AdiniTwistsAreThoseOfTheBilinearCoonsPatch) {
  std::mt19937 random(3);
  const Points data = random_points(random, 12, 3);
  const SplineNet adini = hermite_patch(HermiteVectors::adini, data),
                  bilinear = coons(boundary_cubics(data), CoonsBlending::bilinear);
  for (const double u : {0.0, 1.0})
    for (const double v : {0.0, 1.0})
      expect_near(own_values(adini, u, v).x.row(4), own_values(bilinear, u, v).x.row(4), derivative_sums);
}

TEST(HermitePatch, WeightsOfPointsSumToOneAndOfVectorsToNothing) {
  const NetBuilder builder = hermite_builder(HermiteVectors::sixteen);
  Eigen::VectorXd points = Eigen::VectorXd::Zero(16);
  points.head(4).setOnes();
  expect_near(builder.M * points, Eigen::VectorXd::Ones(16), 0);
  expect_error<InvalidParameter>([] { hermite_patch(HermiteVectors::twelve, Points::Zero(16, 3)); },
                                 {"16 vectors of a Hermite patch: 12"});
}

}  // namespace
}  // namespace sublimit::testing
