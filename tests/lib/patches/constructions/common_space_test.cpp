// SPDX-License-Identifier: Apache-2.0
// Curves in one space of splines are the curves they were.
#include "sublimit/patches/constructions/common_space.h"

#include <gtest/gtest.h>

#include "meshes/construction_data.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

TEST(CommonSpace, LeavesCurvesAsTheyAre) {
  std::mt19937 random(1);
  for (int repeat = 0; repeat < 40; ++repeat) {
    std::vector<CurveNet> curves;
    for (int i = 0; i < 3; ++i) curves.push_back(unit_curve(random, 1 + int(random() % 5)));
    std::vector<CurveNet> common = curves;
    CurveNet* const all[] = {&common[0], &common[1], &common[2]};
    EXPECT_EQ(make_compatible(all), Coordinates::plain);
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_TRUE(std::ranges::equal(common[i].knots.all(), common[0].knots.all()));
      for (const double t : {0.0, 0.1, 0.375, 0.7, 1.0}) expect_near(truth(common[i], t), truth(curves[i], t), sums);
    }
  }
}

TEST(CommonSpace, OpensClosedCurvesOnlyIfItMust) {
  std::mt19937 random(2);
  const Knots<double> closed = Knots<double>::closed(3, {0, 0.25, 0.5, 0.625, 1});
  const std::vector<Knots<double>> same{closed, closed}, other{closed, unit_knots(random, 2)};
  EXPECT_TRUE(common_knots(same).is_closed());
  const Knots<double> opened = common_knots(other);
  EXPECT_FALSE(opened.is_closed());
  const CurveNet curve{closed, random_points(random, 4, 3)};
  for (const double t : {0.0, 0.3, 0.8}) expect_near(truth(in_space(curve, opened), t), truth(curve, t), sums);
}

TEST(CommonSpace, MakesAllRationalIfOneIs) {
  std::mt19937 random(3);
  CurveNet plain = unit_curve(random, 2), rational = homogeneous(unit_curve(random, 3));
  CurveNet* const both[] = {&plain, &rational};
  EXPECT_EQ(make_compatible(both), Coordinates::homogeneous);
  EXPECT_EQ(plain.columns.cols(), 4);
  EXPECT_NEAR((plain.columns.col(3).array() - 1).abs().maxCoeff(), 0, sums);
}

TEST(CommonSpace, RefusesOtherDomains) {
  const std::vector<Knots<double>> knots{bezier_knots<double>(2), Knots<double>::open(1, 2, {0, 0, 2, 2})};
  expect_error<InvalidParameter>([&] { common_knots(knots); }, {"curve 1 is 0 to 2", "curve 0 is 0 to 1"});
}

}  // namespace
}  // namespace sublimit::testing
