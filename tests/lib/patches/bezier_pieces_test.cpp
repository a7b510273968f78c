// SPDX-License-Identifier: Apache-2.0
// Patches bound to their points say what the patches say.
#include "sublimit/patches/detail/bezier_pieces.h"

#include <gtest/gtest.h>

#include <random>

#include "meshes/free_form_shapes.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

Knots<double> random_knots_of(std::mt19937& random, int degree) {
  std::vector<double> breaks{0};
  const auto step = [&] { return 0.25 + std::uniform_real_distribution<>(0, 1)(random); };
  for (auto count = 1 + random() % 6; count > 0; --count)
    breaks.insert(breaks.end(), 1 + random() % unsigned(degree), breaks.back() + step());
  if (random() % 3 == 0) return Knots<double>::closed(degree, breaks);
  std::vector<double> knots(size_t(degree), 0.0);
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  while (std::count(knots.begin(), knots.end(), knots.back()) <= degree) knots.push_back(knots.back());
  return Knots<double>::open(degree, static_cast<Index>(knots.size()) - degree - 1, knots);
}

std::vector<Place> places_with_ends(const PatchSet& set, std::mt19937& random) {
  std::uniform_real_distribution<> parameter(0, 1);
  std::vector<Place> places;
  for (Index face = 0; face < set.faces().size; ++face)
    for (int i = 0; i < 6; ++i)
      places.push_back({face,
                        i == 0   ? 0
                        : i == 1 ? 1
                        : i == 5 ? 1e-12
                                 : parameter(random),
                        i == 2   ? 0
                        : i == 3 ? 1
                                 : parameter(random)});
  places.push_back({-1, 0, 0});
  places.push_back({0, 1.5, 0});
  return places;
}

void expect_the_same(const PatchSet& set, const Points& columns, const std::vector<Place>& places, double tolerance) {
  const auto bound = set.bound(columns);
  ASSERT_NE(dynamic_cast<const BezierPieces*>(bound.get()), nullptr);
  for (int order = 0; order <= 2; ++order) {
    const LimitSamples expected = set.evaluate(columns, places, order);
    LimitSamples made;
    bound->evaluate(places, order, true, made);
    EXPECT_EQ(made.status, expected.status);
    EXPECT_EQ(made.order, expected.order);
    const Points* const a[] = {&made.position, &made.du, &made.dv, &made.duu, &made.duv, &made.dvv, &made.normal};
    const Points* const b[] = {&expected.position, &expected.du,  &expected.dv,    &expected.duu,
                               &expected.duv,      &expected.dvv, &expected.normal};
    for (size_t k = 0; k < 7; ++k) {
      ASSERT_EQ(a[k]->rows(), b[k]->rows());
      for (Eigen::Index i = 0; i < a[k]->rows(); ++i)
        EXPECT_LE((a[k]->row(i) - b[k]->row(i)).norm(), tolerance * (1 + b[k]->row(i).norm()))
            << "quantity " << k << " at " << places[size_t(i)].face << " " << places[size_t(i)].u << " "
            << places[size_t(i)].v;
    }
  }
}

TEST(BezierPieces, AreThePatches) {
  std::mt19937 random(31);
  for (const bool rational : {false, true})
    for (int trial = 0; trial < 30; ++trial) {
      std::vector<std::shared_ptr<const Patch>> patches;
      for (int i = 0; i < 3; ++i)
        patches.push_back(std::make_shared<const SplineSurface>(random_knots_of(random, 1 + (trial + i) % 5),
                                                                random_knots_of(random, 1 + int(random() % 5))));
      const PatchSet set(patches, rational ? Coordinates::homogeneous : Coordinates::plain);
      Points columns(set.num_points(), rational ? 4 : 3);
      for (Index i = 0; i < columns.rows(); ++i) {
        const double w = rational ? std::uniform_real_distribution<>(0.5, 2)(random) : 1;
        for (int c = 0; c < 3; ++c) columns(i, c) = w * std::uniform_real_distribution<>(-1, 1)(random);
        if (rational) columns(i, 3) = w;
      }
      expect_the_same(set, columns, places_with_ends(set, random), 1e-12);
    }
}

TEST(BezierPieces, KnowPolesAndCollapsedSides) {
  std::mt19937 random(32);
  for (const RationalShape& shape : {unit_sphere(), elevated(unit_sphere()), torus()}) {
    const PatchSet set({std::make_shared<const SplineSurface>(shape.surface)}, Coordinates::homogeneous);
    expect_the_same(set, shape.columns, places_with_ends(set, random), 1e-12);
  }
  const auto unit = Knots<double>::open(1, 2, {0, 0, 1, 1});
  const PatchSet set({std::make_shared<const SplineSurface>(unit, unit)}, Coordinates::homogeneous);
  Points columns(4, 4);
  columns << 0, 0, 0, 1, -1, 0, 0, -1, 0, 1, 0, 1, -1, -1, 0, -1;
  expect_the_same(set, columns, {{0, 0.5, 0.5}, {0, 0.25, 0.5}, {0, 1, 1}}, 1e-12);
  expect_error<InvalidParameter>([&] { BezierPieces(set, Points::Zero(4, 3)); }, {"4 x 3", "4 x 4"});
}

TEST(BezierPieces, FarFromTheOriginLoseNothingOfDerivatives) {
  RationalShape shape = torus();
  const PatchSet set({std::make_shared<const SplineSurface>(shape.surface)}, Coordinates::homogeneous);
  const std::vector<Place> places{{0, 0.3, 0.4}, {5, 0.7, 0.1}};
  LimitSamples here, there;
  set.bound(shape.columns)->evaluate(places, 2, true, here);
  shape.columns.col(0) += 1e6 * shape.columns.col(3);
  set.bound(shape.columns)->evaluate(places, 2, true, there);
  constexpr double moved_far = 1e-8;  // what moving the points by 1e6 has rounded, a derivative or two deep
  EXPECT_LE((here.du - there.du).norm(), moved_far);
  EXPECT_LE((here.dvv - there.dvv).norm(), moved_far);
}

}  // namespace
}  // namespace sublimit::testing
