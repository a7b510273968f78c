// SPDX-License-Identifier: Apache-2.0
// Fits to points at given places: against dense solutions, and there and back.
#include "sublimit/fit/scattered_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <random>

#include "laws/tested_schemes.h"
#include "meshes/places.h"
#include "sublimit/surface/limit_map.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Control points of a well posed fit, relative to the mesh; conditions are up to 1e4 here.
constexpr double round_trip = 1e-9, well_posed = 1e4;
/// A dense solution of normal equations, condition 1e4 squared, or of another decomposition.
constexpr double dense_solution = 1e-8;

Points random_points(Index n, Index channels, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Points x(n, channels);
  for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = unit(random);
  return x;
}

class RoundTrip : public ::testing::TestWithParam<TestedScheme> {};

TEST_P(RoundTrip, GivesTheControlPointsBack) {
  const Scheme<double> scheme = GetParam().scheme();
  // Odd tori: on even ones alternating control points of mid-edge have the limit zero.
  std::vector<Mesh> meshes{takes_triangles(scheme) ? triangle_torus(5, 5) : torus(5, 5)};
  // Types of pieces take their time where these are no polynomials, or rotate.
  const bool is_quick = has_polynomials(scheme) && scheme.period == 1;
  if (is_quick || full_sweep()) meshes.push_back(hard_meshes(scheme, 1)[1]);
  for (const Mesh& mesh : meshes) {
    const Index n = mesh.num_vertices();
    const LimitMap surface(scheme, mesh);
    PlaceTargets targets;
    targets.places = random_places(surface.addresses(), 4 * n, 5);
    std::erase_if(targets.places, [&](const Place& s) { return surface.stencil(s).status == LimitStatus::hole; });
    const Points x = jittered(mesh, 0.3).positions;
    targets.values = place_rows(surface, targets.places) * x;
    const ScatteredFit fit = fit_places(surface, targets, Points::Zero(n, 3), {.conditioning = true});
    ASSERT_TRUE(fit.conditioning);
    EXPECT_LE(fit.largest, round_trip * diagonal(x));
    const bool is_well_posed = fit.conditioning->rank == n && fit.conditioning->condition() < well_posed;
    if (&mesh == &meshes[0]) {
      EXPECT_TRUE(is_well_posed) << fit.conditioning->rank << " of " << n << ", " << fit.conditioning->condition();
    }
    if (is_well_posed) {
      EXPECT_LE((fit.points - x).rowwise().norm().maxCoeff(), round_trip * diagonal(x));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, RoundTrip, ::testing::ValuesIn(schemes_and_degrees(5)), test_name);

struct Case {
  LimitMap surface;
  PlaceTargets targets;
  Points guess;
  Eigen::MatrixXd A;
};

Case some_case(int count, Index channels) {
  const Mesh mesh = hard_polygons(6, {.open = true});
  Case c{LimitMap(*find_scheme<double>("catmull-clark"), mesh), {}, {}, {}};
  c.targets.places = random_places(c.surface.addresses(), count, 3);
  c.targets.values = random_points(count, channels, 4);
  c.guess = random_points(mesh.num_vertices(), channels, 5);
  c.A = Eigen::MatrixXd(place_rows(c.surface, c.targets.places));
  return c;
}

TEST(ScatteredFit, RowsAreStencils) {
  const Case c = some_case(20, 1);
  for (Index i = 0; i < 20; ++i) {
    const LimitStencil stencil = c.surface.stencil(c.targets.places[size_t(i)]);
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(c.A.cols());
    for (size_t j = 0; j < stencil.vertices.size(); ++j) row[stencil.vertices[j]] = stencil.weights(0, Eigen::Index(j));
    EXPECT_EQ(row, c.A.row(i));
  }
}

TEST(ScatteredFit, SolvesTheNormalEquationsWithFairnessAndPins) {
  Case c = some_case(600, 5);
  const Index n = Index(c.guess.rows());
  c.targets.weights.assign(600, 1);
  for (size_t i = 0; i < 600; i += 3) c.targets.weights[i] = 2.5;
  c.targets.weights[7] = 0;
  const Fairness fairness{.thin_plate = 0.01, .membrane = 0.02};
  const Pins pins{{5, 0, n - 1}, random_points(3, 5, 9)};
  const ScatteredFit fit = fit_places(c.surface, c.targets, c.guess, {.fairness = fairness, .pins = pins});
  // Without the rows and columns of pinned points.
  const Eigen::VectorXd w = Eigen::Map<const Eigen::VectorXd>(c.targets.weights.data(), 600);
  const Eigen::MatrixXd H(fairness_energy(c.surface, fairness));
  const Eigen::MatrixXd N = c.A.transpose() * w.asDiagonal() * c.A + H;
  const Eigen::MatrixXd gradient =
      N * fit.points - c.A.transpose() * w.asDiagonal() * Eigen::MatrixXd(c.targets.values);
  for (Index v = 0; v < n; ++v) {
    if (v == 0 || v == 5 || v == n - 1) continue;
    EXPECT_LE(gradient.row(v).norm(), dense_solution * N.norm()) << "vertex " << v;
  }
  EXPECT_EQ(fit.points.row(5), pins.values.row(0));
  EXPECT_EQ(fit.points.row(0), pins.values.row(1));
  EXPECT_EQ(fit.points.row(n - 1), pins.values.row(2));
  const Points limit = c.A * fit.points - c.targets.values;
  EXPECT_LE((fit.residuals - limit.rowwise().norm()).norm(), dense_solution);
  EXPECT_NEAR(fit.rms, std::sqrt(w.dot(limit.rowwise().squaredNorm()) / w.sum()), dense_solution);
  EXPECT_EQ(fit.largest, fit.residuals.maxCoeff());
  // Pins that say no value keep the first guess.
  const ScatteredFit kept = fit_places(c.surface, c.targets, c.guess, {.fairness = fairness, .pins = {{4}}});
  EXPECT_EQ(kept.points.row(4), c.guess.row(4));
}

TEST(ScatteredFit, StaysNearTheGuessWhereTargetsAreFew) {
  const Case c = some_case(20, 2);
  const Index n = Index(c.guess.rows());
  const ScatteredFit fit = fit_places(c.surface, c.targets, c.guess, {.conditioning = true});
  ASSERT_LT(20, n);
  EXPECT_EQ(fit.conditioning->rank, 20);
  EXPECT_EQ(fit.conditioning->columns, n);
  EXPECT_LE(fit.largest, round_trip);
  const Eigen::MatrixXd nearest =
      c.guess + Points(c.A.completeOrthogonalDecomposition().pseudoInverse() * (c.targets.values - c.A * c.guess));
  EXPECT_LE((fit.points - nearest).norm(), dense_solution * nearest.norm());
  // A target without weight and one twice: neither adds to the rank.
  PlaceTargets more = c.targets;
  more.places.push_back({0, 0.25, 0.5});
  more.places.push_back(more.places[3]);
  more.values.conservativeResize(22, Eigen::NoChange);
  more.values.row(20).setConstant(100);
  more.values.row(21) = more.values.row(3);
  more.weights.assign(22, 1);
  more.weights[20] = 0;
  const ScatteredFit same = fit_places(c.surface, more, c.guess, {.conditioning = true});
  EXPECT_EQ(same.conditioning->rank, 20);
  EXPECT_EQ(same.conditioning->rows, 21);
  EXPECT_LE((same.points - nearest).norm(), dense_solution * nearest.norm());
  EXPECT_GT(same.largest, 50) << "targets without weight have residuals";
  // No targets at all.
  const ScatteredFit none = fit_places(c.surface, {}, c.guess);
  EXPECT_LE((none.points - c.guess).norm(), dense_solution);
}

TEST(ScatteredFit, SaysWhatIsWrongAndWhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Mesh mesh = torus(5, 4);
  mesh.holes = {3};
  const LimitMap surface(*find_scheme<double>("catmull-clark"), mesh);
  PlaceTargets good{.places = {{0, 0.5, 0.5}, {1, 0, 1}}, .values = Points::Zero(2, 3)};
  const auto fails = [&](const auto& change, std::initializer_list<std::string_view> parts) {
    PlaceTargets targets = good;
    Points guess = mesh.positions;
    ScatteredFitOptions options;
    change(targets, guess, options);
    expect_error<InvalidParameter>([&] { fit_places(surface, targets, guess, options); }, parts);
  };
  using T = PlaceTargets;
  using O = ScatteredFitOptions;
  fails([](T& t, Points&, O&) { t.places[1].face = 20; }, {"target 1", "face 20", "faces are 0 to 19"});
  fails([](T& t, Points&, O&) { t.places[1].face = -1; }, {"target 1", "face -1"});
  fails([](T& t, Points&, O&) { t.places[0].u = 1.5; }, {"target 0", "1.5", "outside", "square 0 <= u, v <= 1"});
  fails([&](T& t, Points&, O&) { t.places[0].v = nan; }, {"target 0", "nan", "outside"});
  fails([](T& t, Points&, O&) { t.places[1] = {3, 0.5, 0.5}; }, {"target 1", "face 3", "hole"});
  fails([&](T& t, Points&, O&) { t.values(1, 2) = nan; }, {"target 1", "finite"});
  fails([](T& t, Points&, O&) { t.weights = {1, -2}; }, {"target 1", "-2", ">= 0"});
  fails([&](T& t, Points&, O&) { t.weights = {nan, 1}; }, {"target 0", "nan"});
  fails([](T& t, Points&, O&) { t.weights = {1}; }, {"1 weights for 2 targets"});
  fails([](T& t, Points&, O&) { t.values = Points::Zero(2, 2); }, {"2 x 2", "2 x 3"});
  fails([](T&, Points& x, O&) { x = Points::Zero(19, 3); }, {"19 x 3", "20 control points"});
  fails([&](T&, Points& x, O&) { x(6, 0) = nan; }, {"control point 6", "not finite"});
  fails([](T&, Points&, O& o) { o.pins.vertices = {2, 20}; }, {"control point 20", "20, counted from 0"});
  fails([](T&, Points&, O& o) { o.pins.vertices = {2, 5, 2}; }, {"control point 2", "twice"});
  fails([](T&, Points&, O& o) { o.pins = {{2, 5}, Points::Zero(1, 3)}; }, {"1 x 3", "2 x 3"});
  fails([&](T&, Points&, O& o) { o.pins = {{2}, Points::Constant(1, 3, nan)}; }, {"control point 2", "finite"});
  const LimitMap triangles(*find_scheme<double>("loop"), octahedron());
  expect_error<InvalidParameter>(
      [&] {
        place_rows(triangles, {{2, 0.7, 0.4}});
      },
      {"target 0", "(0.7, 0.4)", "triangle u >= 0, v >= 0, u + v <= 1"});
}

}  // namespace
}  // namespace sublimit::testing
