// SPDX-License-Identifier: Apache-2.0
// Rational surfaces with weights that stay: rows, fits and energies of any linear source.
#include "sublimit/patches/detail/weighted_source.h"

#include <gtest/gtest.h>

#include <random>

#include "meshes/free_form_shapes.h"
#include "sublimit/fit/scattered_fit.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// A sphere and a torus, and as many places a face as wanted.
struct WeightedShapes {
  FreeFormPatches found = free_form_patches(free_form_of({testing::unit_sphere(), testing::torus()}), "round.obj");
  Eigen::VectorXd weights = found.columns.col(3);
  Points points = found.columns.leftCols(3).array().colwise() / weights.array();
  WeightedSource source{found.patches, weights};
  std::vector<Place> places(int per_face) const {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> parameter(0, 1);
    std::vector<Place> samples;
    for (Index f = 0; f < source.faces().size; ++f)
      for (int i = 0; i < per_face; ++i) samples.push_back({f, parameter(random), parameter(random)});
    return samples;
  }
};

TEST(WeightedSource, RowsOfPointsAreTheSurface) {
  const WeightedShapes shapes;
  const std::vector<Place> places = shapes.places(10);
  const LimitSamples at = shapes.source.evaluate(shapes.points, places, 2);
  const Points* const expected[] = {&at.position, &at.du, &at.dv, &at.duu, &at.duv, &at.dvv};
  for (size_t i = 0; i < places.size(); ++i) {
    const LimitStencil stencil = shapes.source.stencil(places[i], 2);
    ASSERT_EQ(stencil.weights.rows(), 6);
    for (Eigen::Index r = 0; r < 6; ++r) {
      EXPECT_NEAR(stencil.weights.row(r).sum(), r == 0 ? 1 : 0, rounding(100));
      const Eigen::RowVector3d x = stencil.weights.row(r) * shapes.points(stencil.vertices, Eigen::all);
      EXPECT_LE((x - expected[r]->row(Eigen::Index(i))).norm(), rounding(200)) << i << ", row " << r;
    }
  }
}

TEST(WeightedSource, FitsFindThePointsThatWereMoved) {
  const WeightedShapes shapes;
  std::mt19937_64 random(8);
  std::normal_distribution<double> step;
  Points moved = shapes.points;
  for (double& x : moved.reshaped()) x += 0.2 * step(random);
  PlaceTargets targets{.places = shapes.places(25)};
  targets.values = shapes.source.evaluate(moved, targets.places).position;
  const ScatteredFit fit = fit_places(shapes.source, targets, shapes.points, {.conditioning = true});
  ASSERT_EQ(fit.conditioning->rank, shapes.source.num_points());
  constexpr double residual = 1e-13;   // of a square system, solved once
  constexpr double magnified = 1e-14;  // by the condition
  EXPECT_LE(fit.largest, residual);
  EXPECT_LE((fit.points - moved).cwiseAbs().maxCoeff(), magnified * fit.conditioning->condition());
}

/// Fairness is of the surface and its own parameters: finer nets change nothing, of plain patches and of rational ones.
TEST(WeightedSource, EnergiesAreThoseOfFinerNets) {
  const auto energy = [](const LinearSource& source, const Points& x, const Fairness& fairness) {
    return (x.transpose() * (fairness_energy(source, fairness) * x)).trace();
  };
  const Fairness both[] = {{.thin_plate = 1, .quadrature = 8}, {.membrane = 1, .quadrature = 8}};
  const FreeFormPatches pot = free_form_patches(teapot(), "teapot.obj");
  const auto [fine, S] = pot.patches.refined();
  const WeightedShapes shapes;
  const auto [finer, T] = shapes.found.patches.refined();
  const Points columns = T * shapes.found.columns;
  const WeightedSource rational(finer, columns.col(3));
  for (const Fairness& fairness : both) {
    const double coarse = energy(pot.patches, pot.columns, fairness);
    EXPECT_GT(coarse, 1);
    constexpr double sums_of_squares = 1e-12;  // of thousands of products
    constexpr double inexact_rule = 1e-6;      // rational functions: quadrature is not exact
    EXPECT_NEAR(energy(fine, S * pot.columns, fairness), coarse, sums_of_squares * coarse);
    const double round = energy(shapes.source, shapes.points, fairness);
    EXPECT_GT(round, 1);
    EXPECT_NEAR(energy(rational, columns.leftCols(3).array().colwise() / columns.col(3).array(), fairness), round,
                inexact_rule * round)
        << "rational functions: quadrature is not exact";
  }
}

/// A bilinear patch over knots 0..2 and 0..4: du = (1, 0, 0) and dv = (0, 1/2, 0) per unit of its own parameters.
TEST(WeightedSource, MembraneEnergyIsThatOfOwnParameters) {
  const auto patch =
      std::make_shared<SplineSurface>(Knots<double>::open(1, 2, {0, 0, 2, 2}), Knots<double>::open(1, 2, {0, 0, 4, 4}));
  const PatchSet set({patch});
  Points x(4, 3);
  x << 0, 0, 0, 2, 0, 0, 0, 2, 0, 2, 2, 0;
  const SparseMatrix H = fairness_energy(set, {.membrane = 1});
  EXPECT_NEAR((x.transpose() * (H * x)).trace(), 8 * (1 + 1. / 4), rounding(16));
}

TEST(WeightedSource, RefusesDirectionsAndPlainPatches) {
  WeightedShapes shapes;
  shapes.weights[5] = 0;
  expect_error<InvalidParameter>([&] { WeightedSource(shapes.found.patches, shapes.weights); },
                                 {"weight of point 5 is 0", "direction"});
  expect_error<InvalidParameter>([&] { WeightedSource(shapes.found.patches, Eigen::VectorXd::Ones(3)); },
                                 {"3 weights of 126 control points"});
  const FreeFormPatches pot = free_form_patches(teapot(), "teapot.obj");
  expect_error<UnsupportedTopology>([&] { WeightedSource(pot.patches, Eigen::VectorXd::Ones(pot.columns.rows())); },
                                    {"no weights"});
}

}  // namespace
}  // namespace sublimit::testing
