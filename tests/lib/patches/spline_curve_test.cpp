// SPDX-License-Identifier: Apache-2.0
// B-spline and rational curves: rows, statuses, conics, the projective law, and what is refused.
#include "sublimit/patches/spline_curve.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "sublimit/patches/detail/finer_knots.h"
#include "sublimit/patches/detail/spline_rows.h"
#include "support/expect_error.h"
#include "support/tolerance.h"
#include "truth/classical_splines.h"
#include "truth/fraction.h"

namespace sublimit::testing {
namespace {

Points points_of(std::initializer_list<std::initializer_list<double>> rows) {
  Points points(rows.size(), rows.begin()->size());
  Eigen::Index r = 0;
  for (const auto& row : rows) {
    Eigen::Index c = 0;
    for (const double x : row) points(r, c++) = x;
    ++r;
  }
  return points;
}

/// The unit circle through nine points of a square.
SplineCurve nine_point_circle() { return SplineCurve(Knots<double>::open(2, 9, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4})); }
Points nine_points() {
  const double s = std::sqrt(0.5);
  Eigen::VectorXd weights(9);
  weights << 1, s, 1, s, 1, s, 1, s, 1;
  return homogeneous(points_of({{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}),
                     weights);
}

TEST(SplineCurve, AQuarterOfACircleIsExactInFractions) {
  const auto knots = bezier_knots<Fraction>(2);
  // Columns (w x, w y, w) of (1,0), (1,1), (0,1) with the weights 1, 1, 2; of half a circle, with a control vector.
  const int quarter[3][3] = {{1, 0, 1}, {1, 1, 1}, {0, 2, 2}}, half[3][3] = {{1, 0, 1}, {0, 1, 0}, {-1, 0, 1}};
  for (const auto& columns : {quarter, half})
    for (int k = 0; k <= 12; ++k) {
      std::vector<Fraction> row(3);
      span_rows(knots, 0, Fraction(k, 12), 0, std::span<Fraction>(row));
      Fraction at[3] = {0, 0, 0};
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) at[c] += row[i] * columns[i][c];
      EXPECT_EQ(at[0] * at[0] + at[1] * at[1], at[2] * at[2]);
      EXPECT_NE(at[2], 0);
    }
}

// x = (1 - t^2)/(1 + t^2), y = 2t/(1 + t^2) and their derivatives.
TEST(SplineCurve, DerivativesOfAQuarterOfACircleAreThoseOfItsQuotients) {
  const SplineCurve curve(bezier_knots<double>(2));
  const Points columns = homogeneous(points_of({{1, 0}, {1, 1}, {0, 1}}), Eigen::Vector3d(1, 1, 2));
  for (const double t : {0.0, 1e-12, 0.25, 0.6, 1.0}) {
    const CurvePlace sample{0, t};
    const CurveSamples at = curve.evaluate(columns, {&sample, 1}, 2, Coordinates::homogeneous);
    const double w = 1 + t * t;
    const Eigen::RowVector2d x((1 - t * t) / w, 2 * t / w), first(-4 * t / (w * w), 2 * (1 - t * t) / (w * w)),
        second((12 * t * t - 4) / (w * w * w), (4 * t * t * t - 12 * t) / (w * w * w));
    EXPECT_LE((at.position.row(0) - x).norm(), rounding(3));
    EXPECT_LE((at.first.row(0) - first).norm(), rounding(3, 4));
    EXPECT_LE((at.second.row(0) - second).norm(), rounding(3, 16));
    EXPECT_LE((at.normal.row(0) + x).norm(), rounding(3, 4));  // to the left: towards the centre
  }
}

TEST(SplineCurve, TheNinePointCircleIsRoundAndC1) {
  const SplineCurve circle = nine_point_circle();
  const Points columns = nine_points();
  for (int k = 0; k <= 400; ++k) {
    const CurvePlace sample = circle.place(k / 100.0);
    const CurveSamples at = circle.evaluate(columns, {&sample, 1}, 0, Coordinates::homogeneous);
    EXPECT_NEAR(at.position.row(0).norm(), 1, rounding(3));
  }
  for (int joint = 1; joint <= 3; ++joint) {
    const CurvePlace samples[] = {circle.place(joint, KnotSide::left), circle.place(joint)};
    const CurveSamples at = circle.evaluate(columns, samples, 2, Coordinates::homogeneous);
    EXPECT_EQ(samples[0].segment + 1, samples[1].segment);
    EXPECT_LE((at.position.row(0) - at.position.row(1)).norm(), rounding(3));
    EXPECT_LE((at.first.row(0) - at.first.row(1)).norm(), rounding(6, 4));
    // The second derivatives differ, along the tangent, by 2 * 0.828 = 4 (sqrt(2) - 1).
    const Eigen::RowVector2d jump = at.second.row(1) - at.second.row(0), along = at.first.row(0).normalized();
    EXPECT_NEAR(std::abs(jump.dot(along)), 4 * (std::sqrt(2) - 1), rounding(12, 16));
    EXPECT_NEAR((jump - jump.dot(along) * along).norm(), 0, rounding(12, 16));
    EXPECT_EQ(circle.stencil(samples[1], 1).status, LimitStatus::crease);  // the columns are C^0 only
    EXPECT_EQ(circle.stencil(samples[1], 0).status, LimitStatus::regular);
  }
}

TEST(SplineCurve, MapsOfColumnsAreProjectiveMapsOfTheCurve) {
  std::mt19937 random(14);
  std::uniform_real_distribution<double> weight(0.5, 2);
  for (int degree = 1; degree <= 9; ++degree) {
    const SplineCurve curve(random_knots<double>(random, degree, degree % 2 == 1));
    const Eigen::VectorXd weights = Eigen::VectorXd::NullaryExpr(curve.num_points(), [&] { return weight(random); });
    const Points columns = homogeneous(random_points(random, curve.num_points(), 3), weights);
    Eigen::Matrix4d map = Eigen::Matrix4d::Identity() + 0.1 * Eigen::Matrix4d(random_points(random, 4, 4));
    const std::vector<CurvePlace> samples = {{0, 0}, {0, 0.3}, {curve.num_segments() - 1, 1}};
    const CurveSamples at = curve.evaluate(columns, samples, 1, Coordinates::homogeneous);
    const CurveSamples mapped = curve.evaluate(columns * map.transpose(), samples, 1, Coordinates::homogeneous);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Eigen::Vector4d x = map * Eigen::Vector4d(at.position(i, 0), at.position(i, 1), at.position(i, 2), 1);
      EXPECT_LE((mapped.position.row(i).transpose() - x.head(3) / x[3]).norm(), rounding(4 * degree, 4));
      const Eigen::Vector3d direction = at.first.row(i);
      const Eigen::Vector4d d = map * Eigen::Vector4d(direction[0], direction[1], direction[2], 0);
      const Eigen::Vector3d first = (d.head(3) - d[3] * x.head(3) / x[3]) / x[3];
      EXPECT_LE((mapped.first.row(i).transpose() - first).norm(), other_route * (1 + first.norm()));
    }
    const CurveSamples scaled = curve.evaluate(3 * columns, samples, 0, Coordinates::homogeneous);
    EXPECT_LE((scaled.position - at.position).norm(), rounding(4 * degree, 4));
  }
}

TEST(SplineCurve, WeightsThatGrowGeometricallyAreAMoebiusMapOfTheParameter) {
  std::mt19937 random(15);
  for (int degree = 1; degree <= 9; ++degree) {
    const SplineCurve curve(bezier_knots<double>(degree));
    const Points points = random_points(random, degree + 1, 3);
    const double c = 1.7, t = 0.3;
    const Eigen::VectorXd weights =
        Eigen::VectorXd::NullaryExpr(degree + 1, [&](Eigen::Index i) { return std::pow(c, double(i)); });
    const CurvePlace at{0, t}, image{0, c * t / (1 - t + c * t)};
    EXPECT_LE((curve.evaluate(homogeneous(points, weights), {&at, 1}, 0, Coordinates::homogeneous).position -
               curve.evaluate(points, {&image, 1}).position)
                  .norm(),
              rounding(4 * degree, 2));
  }
}

TEST(SplineCurve, AGrowingWeightDrawsTheCurveToItsPoint) {
  std::mt19937 random(16);
  const SplineCurve curve(Knots<double>::open(3, 6, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3}));
  const Points points = random_points(random, 6, 2);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(6);
  weights[2] = 1e14;
  const CurvePlace sample = curve.place(1.5);
  const CurveSamples at = curve.evaluate(homogeneous(points, weights), {&sample, 1}, 0, Coordinates::homogeneous);
  constexpr double share_of_others = 1e-13;  // 1/weight, and its share at this place
  EXPECT_LE((at.position.row(0) - points.row(2)).norm(), share_of_others);
}

TEST(SplineCurve, OfEqualWeightsIsThePlainOne) {
  std::mt19937 random(17);
  for (int degree = 1; degree <= 9; ++degree) {
    const SplineCurve curve(random_knots<double>(random, degree));
    const Points points = random_points(random, curve.num_points(), 3);
    const std::vector<CurvePlace> samples = {{0, 0}, {0, 0.7}, {curve.num_segments() - 1, 1}};
    const CurveSamples plain = curve.evaluate(points, samples, 2);
    const CurveSamples rational =
        curve.evaluate(homogeneous(points, Eigen::VectorXd::Ones(points.rows())), samples, 2, Coordinates::homogeneous);
    EXPECT_LE((plain.position - rational.position).norm(), rounding(2 * degree, 2));
    EXPECT_LE((plain.first - rational.first).norm(), other_route * (1 + plain.first.norm()));
    EXPECT_LE((plain.second - rational.second).norm(), other_route * (1 + plain.second.norm()));
  }
}

TEST(SplineCurve, FarFromTheOriginKeepsTheDigitsOfItsDerivatives) {
  const SplineCurve curve(Knots<double>::open(3, 5, {0, 0, 0, 0, 0.3, 1, 1, 1, 1}));
  const Points points = points_of({{0, 0}, {1, 2}, {3, 1}, {4, 4}, {6, 5}});
  const Points far = points.rowwise() + Eigen::RowVector2d(0x1p40, -0x1p40);  // still whole numbers
  const std::vector<CurvePlace> samples = {{0, 0.2}, {1, 0.9}};
  const CurveSamples near = curve.evaluate(points, samples, 2), at = curve.evaluate(far, samples, 2);
  EXPECT_LE((near.first - at.first).norm(), rounding(4, 16));
  EXPECT_LE((near.second - at.second).norm(), rounding(4, 64));
}

TEST(SplineCurve, ClosedOnesMeetWithTheirDerivatives) {
  std::mt19937 random(18);
  for (int degree = 2; degree <= 9; ++degree)
    for (const Index points : {1, 2, 3, 12}) {
      std::vector<double> breaks = {0};
      for (Index i = 0; i < points; ++i) breaks.push_back(breaks.back() + 1 + double(random() % 4) / 2);
      const SplineCurve curve(Knots<double>::closed(degree, breaks));
      const Points x = random_points(random, points, 3);
      const CurvePlace samples[] = {curve.place(0), curve.place(0, KnotSide::left)};
      const CurveSamples at = curve.evaluate(x, samples, 2);
      const double h0 = curve.knots().length(0), h1 = curve.knots().length(curve.num_segments() - 1);
      EXPECT_LE((at.position.row(0) - at.position.row(1)).norm(), rounding(degree));
      EXPECT_LE((at.first.row(0) / h0 - at.first.row(1) / h1).norm(), rounding(4 * degree));
      if (degree > 2) {
        EXPECT_LE((at.second.row(0) / (h0 * h0) - at.second.row(1) / (h1 * h1)).norm(), reference);
      }
      EXPECT_EQ(curve.stencil(samples[0], 2).status, degree == 2 ? LimitStatus::crease : LimitStatus::regular);
      if (points == 1) {
        EXPECT_LE((at.position.row(0) - x.row(0)).norm(), rounding(1));
        EXPECT_EQ(at.status[0], LimitStatus::undefined_normal);
      }
    }
}

TEST(SplineCurve, SaysWhereTheSidesOfAKnotDiffer) {
  // Simple, double, triple knot of a cubic, and one of four, where it jumps.
  const SplineCurve curve(Knots<double>::open(3, 14, {0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5}));
  const int smooth[] = {2, 1, 0, -1};
  for (int order = 0; order <= 2; ++order) {
    for (int knot = 1; knot <= 4; ++knot)
      for (const KnotSide side : {KnotSide::left, KnotSide::right})
        EXPECT_EQ(curve.stencil(curve.place(knot, side), order).status,
                  smooth[knot - 1] < order ? LimitStatus::crease : LimitStatus::regular);
    for (const double t : {0.0, 0.5, 5.0}) EXPECT_EQ(curve.stencil(curve.place(t), order).status, LimitStatus::regular);
  }
}

TEST(SplineCurve, APoleHasNoPoint) {
  const SplineCurve curve(bezier_knots<double>(2));
  // w = (1 - 2t)^2
  const Points columns = homogeneous(points_of({{0, 0}, {1, 1}, {2, 0}}), Eigen::Vector3d(1, -1, 1));
  EXPECT_EQ(num_weights_not_positive(columns), 1);
  const CurvePlace samples[] = {{0, 0.5}, {0, 0.25}};
  const CurveSamples at = curve.evaluate(columns, samples, 2, Coordinates::homogeneous);
  EXPECT_EQ(at.status[0], LimitStatus::pole);
  EXPECT_EQ(at.order[0], 0);
  EXPECT_TRUE(at.position.row(0).isZero(0));
  EXPECT_FALSE(has_position(at.status[0]));
  EXPECT_STREQ(name(at.status[0]), "pole");
  EXPECT_EQ(at.status[1], LimitStatus::regular);
}

TEST(SplineCurve, WithoutSpeedHasNoTangent) {
  const SplineCurve curve(bezier_knots<double>(3));
  const Points points = points_of({{0.1, 0.7}, {0.1, 0.7}, {1, 1}, {2, 0}});
  const CurvePlace samples[] = {{0, 0}, {0, 0.5}};
  const CurveSamples at = curve.evaluate(points, samples, 2);
  EXPECT_EQ(at.status[0], LimitStatus::undefined_normal);
  EXPECT_EQ(at.position.row(0), points.row(0));
  EXPECT_TRUE(at.first.row(0).isZero(0));
  EXPECT_EQ(at.status[1], LimitStatus::regular);
}

TEST(SplineCurve, PlacesAndParametersAreTheSame) {
  std::mt19937 random(19);
  const SplineCurve curve(random_knots<double>(random, 4));
  for (Index segment = 0; segment < curve.num_segments(); ++segment)
    for (const double t : {0.0, 0.25, 0.75}) {
      const CurvePlace place = curve.place(curve.parameter({segment, t}));
      EXPECT_EQ(place.segment, segment);
      EXPECT_NEAR(place.t, t, rounding(4, 16));  // parameters up to 16 times as large as the span
    }
}

TEST(SplineCurve, RefusesWhatIsNotThere) {
  const SplineCurve curve(bezier_knots<double>(3));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_error<InvalidParameter>([&] { curve.stencil({1, 0}); }, {"segment 1 does not exist", "0 to 0"});
  expect_error<InvalidParameter>([&] { curve.stencil({0, 1.5}); }, {"t is 1.5"});
  expect_error<InvalidParameter>([&] { curve.stencil({0, nan}); }, {"t is nan"});
  expect_error<InvalidParameter>([&] { curve.stencil({0, 0}, 3); }, {"order 3"});
  const CurvePlace outside[] = {{0, 0}, {0, -1}};
  expect_error<InvalidParameter>([&] { curve.evaluate(Points::Zero(4, 2), outside); }, {"sample 1", "t is -1"});
  expect_error<InvalidParameter>([&] { curve.evaluate(Points::Zero(3, 2), {}); }, {"3 x 2", "4 control points"});
  expect_error<InvalidParameter>([&] { curve.evaluate(Points::Zero(4, 1), {}, 0, Coordinates::homogeneous); },
                                 {"4 x 1"});
  const Points points = Points::Ones(2, 2);
  expect_error<InvalidParameter>([&] { homogeneous(points, Eigen::Vector3d(1, 1, 1)); }, {"3 weights for 2"});
  expect_error<InvalidParameter>([&] { homogeneous(points, Eigen::Vector2d(1, nan)); }, {"weight 1 is nan"});
  expect_error<InvalidParameter>([&] { homogeneous(points, Eigen::Vector2d(0, 0)); }, {"all weights are 0"});
  EXPECT_EQ(homogeneous(points, Eigen::Vector2d(0, 2)), points_of({{1, 1, 0}, {2, 2, 2}}));  // a direction stays
}

}  // namespace
}  // namespace sublimit::testing
