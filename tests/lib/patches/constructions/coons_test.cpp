// SPDX-License-Identifier: Apache-2.0
// Coons patches against the boolean sum of their curves, and Gregory's where twists disagree.
#include "sublimit/patches/constructions/coons.h"

#include <gtest/gtest.h>

#include "meshes/construction_data.h"
#include "sublimit/patches/constructions/gregory_patch.h"
#include "sublimit/patches/constructions/polynomial_curves.h"
#include "sublimit/patches/constructions/ruled.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

/// Random curves that meet.
CoonsBoundary random_boundary(std::mt19937& random) {
  CoonsBoundary curves{unit_curve(random, 1 + int(random() % 4)), unit_curve(random, 1 + int(random() % 4)),
                       unit_curve(random, 1 + int(random() % 4)), unit_curve(random, 1 + int(random() % 4))};
  curves[2].columns.row(0) = curves[0].columns.row(0);
  curves[3].columns.row(0) = curves[0].columns.bottomRows(1);
  curves[2].columns.bottomRows(1) = curves[1].columns.row(0);
  curves[3].columns.bottomRows(1) = curves[1].columns.bottomRows(1);
  return curves;
}

double F(int i, double t) {
  const double values[] = {2 * t * t * t - 3 * t * t + 1, -2 * t * t * t + 3 * t * t, t * t * t - 2 * t * t + t,
                           t * t * t - t * t};
  return values[i];
}

Eigen::RowVectorXd boolean_sum(const CoonsBoundary& c, CoonsBlending blending, double u, double v) {
  const auto f = [&](int i, double t) { return blending == CoonsBlending::bicubic ? F(i, t) : i == 0 ? 1 - t : t; };
  Eigen::RowVectorXd sum =
      f(0, v) * truth(c[0], u) + f(1, v) * truth(c[1], u) + f(0, u) * truth(c[2], v) + f(1, u) * truth(c[3], v);
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) sum -= f(a, u) * f(b, v) * truth(c[size_t(b)], a);
  return sum;
}

TEST(Coons, IsTheBooleanSum) {
  std::mt19937 random(1);
  for (int repeat = 0; repeat < 20; ++repeat)
    for (const CoonsBlending blending : {CoonsBlending::bilinear, CoonsBlending::bicubic}) {
      const CoonsBoundary curves = random_boundary(random);
      const SplineNet net = coons(curves, blending);
      for (const double u : {0.0, 0.3, 0.625, 1.0})
        for (const double v : {0.0, 0.2, 0.875, 1.0})
          expect_near(own_values(net, u, v).x.row(0), boolean_sum(curves, blending, u, v), 10 * sums);
    }
}

TEST(Coons, BoundaryRowsAreTheCurvesThemselves) {
  std::mt19937 random(2);
  CoonsBoundary curves{unit_curve(random, 3), unit_curve(random, 3), unit_curve(random, 3), unit_curve(random, 3)};
  const Knots<double> knots = curves[0].knots;
  for (CurveNet& curve : curves) curve = {knots, random_points(random, knots.num_points(), 3)};
  curves[2].columns.row(0) = curves[0].columns.row(0), curves[3].columns.row(0) = curves[0].columns.bottomRows(1);
  curves[2].columns.bottomRows(1) = curves[1].columns.row(0);
  curves[3].columns.bottomRows(1) = curves[1].columns.bottomRows(1);
  const SplineNet net = coons(curves, CoonsBlending::bicubic);
  EXPECT_EQ(Points(net.columns.topRows(knots.num_points())), curves[0].columns);
  EXPECT_EQ(Points(net.columns.bottomRows(knots.num_points())), curves[1].columns);
}

TEST(Coons, CrossTangentsOfBicubicBlendingKnowTheSideCurvesEndsAlone) {
  std::mt19937 random(3);
  const CoonsBoundary curves = random_boundary(random);
  const SplineNet net = coons(curves, CoonsBlending::bicubic);
  for (const double u : {0.0, 0.3, 0.9}) {
    expect_near(own_values(net, u, 0).x.row(2), F(0, u) * truth(curves[2], 0, 1) + F(1, u) * truth(curves[3], 0, 1),
                100 * sums);
  }
  for (const double u : {0.0, 1.0})
    for (const double v : {0.0, 1.0})
      expect_near(own_values(net, u, v).x.row(4), Eigen::RowVector3d::Zero(), derivative_sums);
}

TEST(Coons, BicubicPatchesOverANetworkThatIsSmoothJoinSmoothly) {
  std::mt19937 random(15);
  const CoonsBoundary left = random_boundary(random);
  CoonsBoundary right = random_boundary(random);
  // The common edge, and side curves that go on with the same derivative.
  right[2] = left[3];
  for (const size_t side : {0, 1}) {
    const CurveNet cubic{bezier_knots<double>(3), random_points(random, 4, 3)};
    right[side] = cubic;
    right[side].columns.row(0) = truth(left[side], 1);
    right[side].columns.row(1) = truth(left[side], 1) + truth(left[side], 1, 1) / 3;
  }
  right[3].columns.row(0) = right[0].columns.row(3), right[3].columns.bottomRows(1) = right[1].columns.row(3);
  const SplineNet S = coons(left, CoonsBlending::bicubic), T = coons(right, CoonsBlending::bicubic);
  const SplineNet bilinear_S = coons(left, CoonsBlending::bilinear), bilinear_T = coons(right, CoonsBlending::bilinear);
  double gap = 0;
  for (const double v : {0.0, 0.2, 0.6, 1.0}) {
    expect_near(own_values(S, 1, v).x.row(0), own_values(T, 0, v).x.row(0), 10 * sums);
    expect_near(own_values(S, 1, v).x.row(1), own_values(T, 0, v).x.row(1), 1000 * sums);
    gap = std::max(gap, (own_values(bilinear_S, 1, v).x.row(1) - own_values(bilinear_T, 0, v).x.row(1)).norm());
  }
  EXPECT_GT(gap, 0.01);  // with linear blending they meet, no more
}

TEST(Coons, OfFourSegmentsIsTheBilinearPatch) {
  std::mt19937 random(4);
  const Points p = random_points(random, 4, 3);
  const auto segment = [&](Index a, Index b) {
    Points ends(2, 3);
    ends << p.row(a), p.row(b);
    return bezier_curve(ends);
  };
  const SplineNet net = coons({segment(0, 1), segment(2, 3), segment(0, 2), segment(1, 3)}, CoonsBlending::bilinear);
  expect_near(net.columns, bilinear_patch(p).columns, 0);
}

TEST(Coons, BuilderMatrixMakesTheNetAndSumsToOne) {
  std::mt19937 random(5);
  const CoonsBoundary curves = random_boundary(random);
  for (const CoonsBlending blending : {CoonsBlending::bilinear, CoonsBlending::bicubic}) {
    const NetBuilder builder =
        coons_builder({curves[0].knots, curves[1].knots, curves[2].knots, curves[3].knots}, blending);
    Points data(builder.M.cols(), 3);
    data << curves[0].columns, curves[1].columns, curves[2].columns, curves[3].columns;
    expect_near(built(builder, data, Coordinates::plain).columns, coons(curves, blending).columns, 0);
    expect_near(builder.M * Eigen::VectorXd::Ones(data.rows()), Eigen::VectorXd::Ones(builder.M.rows()), sums);
  }
}

TEST(Coons, TakesRationalCurves) {
  std::mt19937 random(6);
  CoonsBoundary curves = random_boundary(random);
  curves[0] = homogeneous(curves[0]);
  curves[0].columns.row(1) *= 2;
  if (curves[0].knots.num_points() == 2) GTEST_FAIL() << "a curve with an inner control point is needed";
  const SplineNet net = coons(curves, CoonsBlending::bilinear);
  const Eigen::RowVectorXd column = truth(curves[0], 0.4);
  expect_near(own_values(net, 0.4, 0).x.row(0), column.head(3) / column[3], sums);
}

TEST(Coons, NamesTheCornerAndTheGap) {
  std::mt19937 random(7);
  CoonsBoundary curves = random_boundary(random);
  curves[3].columns(0, 1) += 0.125;
  expect_error<InvalidMesh>([&] { coons(curves, CoonsBlending::bilinear); },
                            {"corner (1,0)", "c0 and d1", "0.125 apart"});
  const SplineNet net = coons(curves, CoonsBlending::bilinear, 0.2);
  EXPECT_NEAR(boundary_gap(curves).distance, 0.125, sums);
  const Eigen::RowVectorXd mean = (truth(curves[0], 1) + truth(curves[3], 0)) / 2;
  expect_near(own_values(net, 1, 0).x.row(0), mean, sums);
  curves[1].knots = Knots<double>::open(1, 2, {0, 0, 2, 2});
  curves[1].columns = Points::Zero(2, 3);
  expect_error<InvalidParameter>([&] { coons(curves, CoonsBlending::bicubic); }, {"c1: its domain is 0 to 2"});
}

/// A random bicubic surface, and its own data.
struct Bicubic {
  SplineNet net;
  CoonsBoundary curves, fields;
  Points twists{4, 3};
};
Bicubic random_bicubic(std::mt19937& random) {
  const Knots<double> cubic = bezier_knots<double>(3);
  const Points P = random_points(random, 16, 3);
  const auto row = [&](Index i, Index j, bool along_u, bool across) {
    Points points(4, 3);
    for (Index k = 0; k < 4; ++k) {
      const auto at = [&](Index offset) { return along_u ? P.row(4 * (j + offset) + k) : P.row(4 * k + i + offset); };
      const Index inner = (along_u ? j : i) == 0 ? 0 : -1;
      if (across)
        points.row(k) = 3 * (at(inner + 1) - at(inner));
      else
        points.row(k) = at(0);
    }
    return CurveNet{cubic, points};
  };
  Bicubic result{spline_net(cubic, cubic, P),
                 {row(0, 0, true, false), row(0, 3, true, false), row(0, 0, false, false), row(3, 0, false, false)},
                 {row(0, 0, true, true), row(0, 3, true, true), row(0, 0, false, true), row(3, 0, false, true)}};
  for (Index c = 0; c < 4; ++c) result.twists.row(c) = own_values(result.net, double(c % 2), double(c / 2)).x.row(4);
  return result;
}

TEST(GeneralCoons, ReproducesBicubicSurfaces) {
  std::mt19937 random(8);
  const Bicubic given = random_bicubic(random);
  expect_near(general_coons(given.curves, given.fields, given.twists).columns, given.net.columns, 100 * sums);
}

TEST(GeneralCoons, HasItsCrossDerivatives) {
  std::mt19937 random(9);
  Bicubic given = random_bicubic(random);
  // Another field with the same ends and the same derivatives there.
  const Knots<double> knots = Knots<double>::open(3, 6, {0, 0, 0, 0, 0.25, 0.5, 1, 1, 1, 1});
  for (CurveNet& field : given.fields) {
    const CurveNet cubic = field;
    field = {knots, random_points(random, 6, 3)};
    for (const int end : {0, 1}) {
      const Index corner = end == 0 ? 0 : 5, beside = end == 0 ? 1 : 4;
      const double step = end == 0 ? 0.25 / 3 : -0.5 / 3;
      field.columns.row(corner) = truth(cubic, end);
      field.columns.row(beside) = truth(cubic, end) + step * truth(cubic, end, 1);
    }
  }
  const SplineNet net = general_coons(given.curves, given.fields, given.twists);
  for (const double t : {0.0, 0.2, 0.7, 1.0}) {
    expect_near(own_values(net, t, 0).x.row(0), truth(given.curves[0], t), 10 * sums);
    expect_near(own_values(net, t, 0).x.row(2), truth(given.fields[0], t), 1000 * sums);
    expect_near(own_values(net, t, 1).x.row(2), truth(given.fields[1], t), 1000 * sums);
    expect_near(own_values(net, 0, t).x.row(1), truth(given.fields[2], t), 1000 * sums);
    expect_near(own_values(net, 1, t).x.row(1), truth(given.fields[3], t), 1000 * sums);
  }
}

TEST(GeneralCoons, NamesTheCornerOfWhatDisagrees) {
  std::mt19937 random(10);
  Bicubic given = random_bicubic(random);
  Points twists = given.twists;
  twists(2, 0) += 0.5;
  expect_error<InvalidMesh>([&] { general_coons(given.curves, given.fields, twists); },
                            {"corner (0,1)", "the derivative of xv1 and the twist differ by 0.5", "gregory"});
  CoonsFields fields = given.fields;
  fields[1].columns(3, 2) += 0.25;
  expect_error<InvalidMesh>([&] { general_coons(given.curves, fields, given.twists); },
                            {"corner (1,1)", "xv1 and the derivative of d1 differ by 0.25"});
  fields[0] = homogeneous(given.fields[0]);
  expect_error<InvalidParameter>([&] { general_coons(given.curves, fields, given.twists); }, {"xv0 is rational"});
}

/// Fields whose derivatives disagree at two corners.
Bicubic with_disagreeing_twists(std::mt19937& random) {
  Bicubic given = random_bicubic(random);
  given.fields[0].columns.row(1) += Eigen::RowVector3d(1, -0.5, 0.25);  // of xv0 at (0,0)
  given.fields[3].columns.row(2) += Eigen::RowVector3d(0.5, 1, 0.125);  // of xu1 at (1,1)
  return given;
}

TEST(Gregory, HasCurvesAndCrossDerivativesWhereTwistsDisagree) {
  std::mt19937 random(11);
  const Bicubic given = with_disagreeing_twists(random);
  const GregoryNet net = gregory_patch(given.curves, given.fields);
  EXPECT_EQ(net.patch->blended(), (std::array<bool, 4>{true, false, false, true}));
  const auto at = [&](double u, double v) { return own_values(*net.patch, net.columns, Coordinates::plain, u, v); };
  for (const double t : {0.0, 1e-9, 0.2, 0.7, 1.0}) {
    expect_near(at(t, 0).x.row(0), truth(given.curves[0], t), 10 * sums);
    expect_near(at(0, t).x.row(0), truth(given.curves[2], t), 10 * sums);
    expect_near(at(t, 0).x.row(2), truth(given.fields[0], t), 100 * sums);
    expect_near(at(t, 1).x.row(2), truth(given.fields[1], t), 100 * sums);
    expect_near(at(0, t).x.row(1), truth(given.fields[2], t), 100 * sums);
    expect_near(at(1, t).x.row(1), truth(given.fields[3], t), 100 * sums);
  }
}

TEST(Gregory, DerivativesAreThoseOfItsPoints) {
  std::mt19937 random(12);
  const Bicubic given = with_disagreeing_twists(random);
  const GregoryNet net = gregory_patch(given.curves, given.fields);
  const auto at = [&](double u, double v) { return own_values(*net.patch, net.columns, Coordinates::plain, u, v).x; };
  const double h = 1e-4;
  for (const double u : {0.15, 0.6})
    for (const double v : {0.2, 0.85}) {
      const auto x = at(u, v);
      const auto east = at(u + h, v), west = at(u - h, v), north = at(u, v + h), south = at(u, v - h);
      constexpr double central_differences = 1e-5;
      expect_near(x.row(1), (east.row(0) - west.row(0)) / (2 * h), central_differences);
      expect_near(x.row(2), (north.row(0) - south.row(0)) / (2 * h), central_differences);
      expect_near(x.row(3), (east.row(1) - west.row(1)) / (2 * h), central_differences);
      expect_near(x.row(4), (east.row(2) - west.row(2)) / (2 * h), central_differences);
      expect_near(x.row(5), (north.row(2) - south.row(2)) / (2 * h), central_differences);
    }
}

TEST(Gregory, SecondDerivativesAreUnboundedAtItsCorners) {
  std::mt19937 random(13);
  const Bicubic given = with_disagreeing_twists(random);
  const GregoryNet net = gregory_patch(given.curves, given.fields);
  for (const auto& [u, v, status] :
       std::initializer_list<std::tuple<double, double, LimitStatus>>{{0, 0, LimitStatus::unbounded_second},
                                                                      {1, 1, LimitStatus::unbounded_second},
                                                                      {1, 0, LimitStatus::regular},
                                                                      {0, 1, LimitStatus::regular},
                                                                      {0.5, 0, LimitStatus::regular}}) {
    const LimitStencil stencil = net.patch->stencil({0, u, v}, 2);
    EXPECT_EQ(stencil.status, status);
    EXPECT_EQ(stencil.weights.rows(), status == LimitStatus::regular ? 6 : 3);
    EXPECT_NEAR(stencil.weights.row(0).sum(), 1, sums);
    EXPECT_NEAR(stencil.weights.row(1).sum(), 0, sums);
  }
  EXPECT_EQ(net.patch->stencil({0, 0, 0}, 1).status, LimitStatus::regular);
}

TEST(Gregory, IsTheGeneralPatchWhereTwistsAgree) {
  std::mt19937 random(14);
  const Bicubic given = random_bicubic(random);
  const GregoryNet net = gregory_patch(given.curves, given.fields);
  EXPECT_EQ(net.patch->blended(), (std::array<bool, 4>{}));
  expect_near(own_values(*net.patch, net.columns, Coordinates::plain, 0.3, 0.8).x, own_values(given.net, 0.3, 0.8).x,
              derivative_sums);
}

}  // namespace
}  // namespace sublimit::testing
