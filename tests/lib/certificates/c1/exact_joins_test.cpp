// SPDX-License-Identifier: Apache-2.0
// Joins of the doubles as they are: what rounding hides, and what it does not touch.
#include "sublimit/certificates/c1/exact_joins.h"

#include <gtest/gtest.h>

#include <cmath>

#include "meshes/spline_models.h"

namespace sublimit::testing {
namespace {

TEST(ExactJoins, CurvesOfDoublesAreDecidedToTheLastBit) {
  const BezierPiece<double> left{.degree = 2, .columns = {0, 0, 0.1, 0.3, 0.5, 0.5}};
  // C^1 by reflection: 2 c_0 - b_1, each of its doubles rounded once.
  BezierPiece<double> right{.degree = 2, .columns = {0.5, 0.5, 0.9, 0.7, 1, 0}};
  EXPECT_EQ(curve_join(left, right).orders.c, 1);
  const CurveJoin exact = exact_curve_join(in_ratios(left), in_ratios(right));
  EXPECT_EQ(exact.orders.c, 0);  // 0.1 + 0.9 is not 1
  EXPECT_EQ(exact.orders.g, 0);
  constexpr double last_bit = 1e-15;  // of one coordinate, as an angle
  EXPECT_LT(*exact.angle, last_bit);
  // Dyadic ones are equal.
  const BezierPiece<double> dyadic{.degree = 2, .columns = {0, 0, 0.125, 0.25, 0.5, 0.5}};
  right.columns = {0.5, 0.5, 0.875, 0.75, 1, 0};
  EXPECT_EQ(exact_curve_join(in_ratios(dyadic), in_ratios(right)).orders.g, 1);
  right.length = 0.5;
  const CurveJoin faster = exact_curve_join(in_ratios(dyadic), in_ratios(right));
  EXPECT_EQ(faster.orders.c, 0);
  EXPECT_EQ(faster.orders.g, 1);
  EXPECT_EQ(faster.ratios[0], 2);
}

/// The circle by quarters (1 - t^2, 2 t)/(1 + t^2), each with twice the weights of the one before: exact in doubles.
std::vector<std::array<double, 3>> dyadic_circle(double centre) {
  const double x[] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, y[] = {0, 1, 1, 1, 0, -1, -1, -1, 0},
               w[] = {1, 1, 2, 2, 4, 4, 8, 8, 16};
  std::vector<std::array<double, 3>> columns;
  for (int i = 0; i < 9; ++i) columns.push_back({w[i] * (centre + x[i]), w[i] * y[i], w[i]});
  return columns;
}
Knots<double> circle_of_nine() { return Knots<double>::open(2, 9, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}); }

/// Of radii `centre` and 1; with 0 it is the unit sphere, twice.
SplineModel dyadic_torus(double centre) {
  SplineModel model{.coordinates = Coordinates::homogeneous};
  model.add(circle_of_nine(), circle_of_nine());
  const std::vector<std::array<double, 3>> circle = dyadic_circle(0), profile = dyadic_circle(centre);
  for (Index j = 0; j < 9; ++j)
    for (Index i = 0; i < 9; ++i) {
      const auto& [x, y, w] = circle[size_t(i)];
      const auto& [radius, z, weight] = profile[size_t(j)];
      model.columns[0].row(i + 9 * j) << x * radius, y * radius, w * z, w * weight;
    }
  return model;
}

TEST(ExactJoins, SeamsOfRationalSpheresAndToriAreG2) {
  for (const double centre : {3.0, 0.0}) {
    const SplineModel model = dyadic_torus(centre);
    const std::vector<PatchColumns> patches = model.patches();
    const PatchSeams found = patch_seams(patches, model.coordinates);
    const std::vector<std::optional<JoinOrders>> exact = exact_seams(patches, model.coordinates, found.seams);
    ASSERT_EQ(exact.size(), found.seams.size());
    EXPECT_EQ(exact.size(), 6 + 2);
    for (size_t i = 0; i < exact.size(); ++i) {
      EXPECT_EQ(exact[i].has_value(), found.seams[i].is_compared());
      if (!exact[i]) continue;
      const PatchSeam& seam = found.seams[i];
      if (centre == 0 && !seam.lines[0].along_v && (seam.knot == 1 || seam.knot == 3)) {  // the sphere's poles
        EXPECT_EQ(exact[i]->obstacle, JoinObstacle::no_tangent);
        EXPECT_EQ(seam.measured->g, 0);
        continue;
      }
      EXPECT_EQ(*exact[i], (JoinOrders{0, 2, false, JoinObstacle::none})) << name(exact[i]->obstacle);
      EXPECT_EQ(seam.measured->g, 2);
    }
  }
}

TEST(ExactJoins, RoundedWeightsAreSmoothUpToRoundingOnly) {
  // sqrt(1/2) sqrt(1/2) is not 1/2: the weights of corners do not factor, and parallels are no circles.
  for (const SplineModel& model : {nurbs_sphere(), nurbs_torus()}) {
    const std::vector<PatchColumns> patches = model.patches();
    const PatchSeams found = patch_seams(patches, model.coordinates);
    const std::vector<std::optional<JoinOrders>> exact = exact_seams(patches, model.coordinates, found.seams);
    JoinOrders all{9, 9, false, JoinObstacle::none};
    for (size_t i = 0; i < exact.size(); ++i) {
      if (!exact[i]) continue;
      EXPECT_EQ(found.seams[i].measured->g, 2);
      EXPECT_GE(exact[i]->c, 0);
      all = worst(all, *exact[i]);
    }
    EXPECT_EQ(all, (JoinOrders{0, 0, false, JoinObstacle::angle}));
  }
}

TEST(ExactJoins, KnotLinesAndCutsOfDyadicDataAreExact) {
  // Bicubic with dyadic numbers, cut at a simple knot.
  SplineModel whole;
  whole.add(Knots<double>::open(3, 6, {0, 0, 0, 0, 1, 1, 2, 2, 2, 2}),
            Knots<double>::open(3, 5, {0, 0, 0, 0, 1, 2, 2, 2, 2}), [](double u, double v) -> Eigen::RowVector3d {
              const auto rounded = [](double x) { return std::round(64 * x) / 64; };
              return {rounded(u), rounded(v), rounded(std::sin(9 * u + 5 * v))};
            });
  SplineModel halves;
  for (const SplineModel& half : cut_in_u(whole, 1)) halves.append(half);
  const auto orders_of = [](const SplineModel& model, SeamKind kind) {
    const std::vector<PatchColumns> patches = model.patches();
    const PatchSeams found = patch_seams(patches, model.coordinates, {.smooth = 9});
    const std::vector<std::optional<JoinOrders>> exact = exact_seams(patches, model.coordinates, found.seams);
    for (size_t i = 0; i < exact.size(); ++i)
      if (found.seams[i].kind == kind && found.seams[i].lines[0].along_v) {
        EXPECT_EQ(exact[i]->c, found.seams[i].measured->c);
        EXPECT_EQ(exact[i]->g, found.seams[i].measured->g);
        return *exact[i];
      }
    return JoinOrders{};
  };
  EXPECT_EQ(orders_of(whole, SeamKind::knot), (JoinOrders{1, 1, false, JoinObstacle::curvature}));
  EXPECT_EQ(orders_of(halves, SeamKind::sides), (JoinOrders{1, 1, false, JoinObstacle::curvature}));
  for (const int arrangement : {1, 2, 4, 7}) {
    SplineModel turned = halves.only(0);
    turned.append(arranged(halves.only(1), arrangement));
    const PatchSeams found = patch_seams(turned.patches(), turned.coordinates);
    const auto at = std::ranges::find(found.seams, SeamKind::sides, &PatchSeam::kind);
    const std::optional<JoinOrders> exact = exact_seams(turned.patches(), turned.coordinates, {&*at, 1})[0];
    EXPECT_EQ(exact->c, 1);
    EXPECT_EQ(exact->g, 1);
  }
  // The last bit of one coordinate.
  SplineModel moved = halves;
  moved.columns[1](1, 2) = std::nextafter(moved.columns[1](1, 2), 9);
  const PatchSeams found = patch_seams(moved.patches(), moved.coordinates);
  const auto at = std::ranges::find(found.seams, SeamKind::sides, &PatchSeam::kind);
  EXPECT_EQ(at->measured->g, 1);
  EXPECT_EQ(exact_seams(moved.patches(), moved.coordinates, {&*at, 1})[0]->g, 0);
}

TEST(ExactJoins, PatchesGivenByRatios) {
  // A third is not a double, but a ratio: c - b = 1/3 (b - a).
  const auto ratio = [](long p, long q) { return Rational(p, q); };
  const BezierPatch<Rational> left{
      .degree_u = 1, .degree_v = 1, .columns = {-1, 0, 0, 0, 0, 0, -1, 1, ratio(1, 7), 0, 1, 0}};
  const BezierPatch<Rational> right{
      .degree_u = 1, .degree_v = 1, .columns = {0, 0, 0, ratio(1, 3), 0, 0, 0, 1, 0, ratio(1, 3), 1, ratio(-1, 21)}};
  const SurfaceJoin join = exact_surface_join(left, right);
  EXPECT_EQ(*join.exact, (JoinOrders{0, 2, false, JoinObstacle::none}));
  BezierPatch<Rational> longer = left;
  longer.length = ratio(3, 1);
  EXPECT_TRUE(exact_surface_join(longer, right).exact->is_same);
}

}  // namespace
}  // namespace sublimit::testing
