// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/knots.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/expect_error.h"
#include "truth/classical_splines.h"
#include "truth/fraction.h"

namespace sublimit::testing {
namespace {

using Doubles = std::vector<double>;

TEST(Knots, OpenOnesHaveAFaceForEverySpanThatIsNotEmpty) {
  const auto knots = Knots<double>::open(2, 7, {0, 0, 0, 1, 1, 2, 4, 5, 6, 7});
  EXPECT_EQ(knots.num_faces(), 4);
  EXPECT_EQ(knots.begin(), 0);
  EXPECT_EQ(knots.end(), 5);
  const Index spans[] = {2, 4, 5, 6};
  for (Index face = 0; face < 4; ++face) EXPECT_EQ(knots.span(face), spans[face]);
  EXPECT_EQ(knots.length(1), 1);
  EXPECT_EQ(knots.length(2), 2);
  EXPECT_EQ(knots.continuity(0, KnotSide::left), std::nullopt);
  EXPECT_EQ(knots.continuity(0, KnotSide::right), 0);
  EXPECT_EQ(knots.continuity(1, KnotSide::left), 0);
  EXPECT_EQ(knots.continuity(2, KnotSide::left), 1);
  EXPECT_EQ(knots.continuity(3, KnotSide::right), std::nullopt);
}

TEST(Knots, AKnotBelongsToTheRightUnlessTheLeftIsAskedFor) {
  const auto knots = Knots<double>::open(2, 6, {0, 0, 0, 1, 1, 2, 4, 4, 4});
  const auto expect = [&](double t, KnotSide side, Index face, double u) {
    const KnotPlace<double> place = knots.place(t, side);
    EXPECT_EQ(place.face, face) << t;
    EXPECT_EQ(place.u, u) << t;
    EXPECT_EQ(knots.parameter(place), t);
  };
  expect(0, KnotSide::right, 0, 0);
  expect(0, KnotSide::left, 0, 0);
  expect(1, KnotSide::right, 1, 0);
  expect(1, KnotSide::left, 0, 1);
  expect(1.25, KnotSide::left, 1, 0.25);
  expect(2, KnotSide::right, 2, 0);
  expect(2, KnotSide::left, 1, 1);
  expect(4, KnotSide::right, 2, 1);
  expect(4, KnotSide::left, 2, 1);
  const auto closed = Knots<double>::closed(3, {0, 1, 3});
  EXPECT_EQ(closed.place(0, KnotSide::left).face, 1);
  EXPECT_EQ(closed.place(0, KnotSide::left).u, 1);
}

TEST(Knots, WithoutTheFirstAndTheLastAreDoubledAtTheEnds) {
  const auto full = Knots<double>::open(3, 5, {0, 0, 0, 0, 1, 2, 2, 2, 2});
  const auto given = Knots<double>::open(3, 5, {0, 0, 0, 1, 2, 2, 2});
  EXPECT_TRUE(given.ends_were_doubled());
  EXPECT_FALSE(full.ends_were_doubled());
  EXPECT_TRUE(std::ranges::equal(given.all(), full.all()));
}

TEST(Knots, ClosedOnesGoOnWithThePeriod) {
  const auto knots = Knots<double>::closed(3, {0, 1, 3});  // 2 points, period 3
  EXPECT_EQ(Doubles(knots.all().begin(), knots.all().end()), (Doubles{-5, -3, -2, 0, 1, 3, 4, 6, 7}));
  EXPECT_EQ(knots.num_points(), 2);
  EXPECT_EQ(knots.num_functions(), 5);
  EXPECT_EQ(knots.point(3), 1);
  EXPECT_EQ(knots.num_faces(), 2);
  EXPECT_EQ(knots.continuity(0, KnotSide::left), 2);
  EXPECT_EQ(knots.continuity(1, KnotSide::right), 2);
  const auto one = Knots<double>::closed(2, {1, 1.5});
  EXPECT_EQ(Doubles(one.all().begin(), one.all().end()), (Doubles{0, 0.5, 1, 1.5, 2, 2.5}));
  // A double knot where it closes, given on either side: C^1 in degree 3.
  EXPECT_EQ(Knots<double>::closed(3, {0, 0, 1, 3}).continuity(0, KnotSide::left), 1);
  EXPECT_EQ(Knots<double>::closed(3, {0, 1, 3, 3}).continuity(0, KnotSide::left), 1);
  EXPECT_EQ(Knots<double>::closed(3, {0, 0.1, 0.3, 0.3}).continuity(1, KnotSide::right), 1);
}

TEST(Knots, GrevilleAbscissaeReproduceTheParameter) {
  std::mt19937 random(2);
  for (int degree = 1; degree <= 9; ++degree)
    for (int repeat = 0; repeat < 20; ++repeat) {
      const auto knots = random_knots<Fraction>(random, degree, repeat % 4 == 3);
      const std::vector<Fraction> greville = knots.greville();
      for (Index face = 0; face < knots.num_faces(); ++face) {
        const Index k = knots.span(face);
        const Fraction t = knots.parameter({face, Fraction(2, 5)});
        Fraction sum(0);
        for (Index i = k - degree; i <= k; ++i) sum += greville[i] * cox_de_boor(knots.all(), k, i, degree, t);
        EXPECT_EQ(sum, t);
      }
    }
}

TEST(Knots, TypesAreLocalKnotsUpToShiftAndScale) {
  // Uniform inside: one type; clamped ends: degree - 1 more on each side.
  Doubles knots(4, 0);
  for (int i = 1; i < 20; ++i) knots.push_back(0.5 * i);
  knots.insert(knots.end(), 4, 10.0);
  const auto clamped = Knots<double>::open(3, 23, knots);
  EXPECT_EQ(clamped.type(0), (Doubles{0, 0, 1, 2}));
  EXPECT_EQ(clamped.type(1), (Doubles{1, 1, 1, 2}));
  for (Index face = 2; face < 18; ++face) EXPECT_EQ(clamped.type(face), (Doubles{1, 2, 1, 2}));
  EXPECT_EQ(clamped.type(19), (Doubles{1, 2, 0, 0}));
}

TEST(Knots, OfDegreeZeroAreSteps) {
  const auto steps = Knots<double>::open(0, 3, {0, 1, 2, 4});
  EXPECT_EQ(steps.num_faces(), 3);
  EXPECT_EQ(steps.continuity(1, KnotSide::left), -1);
  EXPECT_EQ(steps.greville(), (Doubles{0.5, 1.5, 3}));
  EXPECT_EQ(Knots<double>::closed(0, {0, 1, 2}).num_faces(), 2);
}

void refused(int degree, Index points, const Doubles& knots, std::initializer_list<std::string_view> parts) {
  expect_error<InvalidParameter>([&] { Knots<double>::open(degree, points, knots); }, parts);
}
void refused_closed(int degree, const Doubles& breaks, std::initializer_list<std::string_view> parts) {
  expect_error<InvalidParameter>([&] { Knots<double>::closed(degree, breaks); }, parts);
}

TEST(Knots, ThatAreNoneAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  refused(26, 30, {}, {"degree 26", "0 to 25"});
  refused(-1, 30, {}, {"degree -1"});
  refused(3, 3, {0, 0, 0, 1, 1, 1, 1}, {"3 control points of degree 3", "at least 4"});
  refused(3, 5, {0, 0, 0, 0, 1, 1, 1, 1}, {"8 knots for 5 control points of degree 3", "9 are needed", "or 7 without"});
  refused(0, 2, {0}, {"1 knots for 2 control points of degree 0: 3 are needed"});
  refused(1, 3, {0, 0, nan, 1, 1}, {"knot 2 is nan", "finite"});
  refused(1, 3, {0, 0, inf, 1, 1}, {"knot 2 is inf", "finite"});
  refused(1, 3, {0, 0, 1, 0.5, 2}, {"knot 3 is 0.5", "less than the one before, 1"});
  refused(1, 4, {0, 1, 1, 1, 2, 3}, {"knot 1 is 1", "occurs 3 times", "degree 1 at most 2", "control point 1"});
  refused(2, 6, {0, 0, 0, 1, 1, 1, 1, 2, 2}, {"knot 3 is 1", "occurs 4 times", "control point 3"});
  refused(1, 3, {0, 1, 1, 1, 2}, {"knots 1 and 3 are both 1", "length"});
  refused_closed(2, {1}, {"1 break points", "at least 2"});
  refused_closed(2, {}, {"0 break points"});
  refused_closed(2, {0, 1, nan}, {"knot 2 is nan"});
  refused_closed(2, {0, 2, 1}, {"knot 2 is 1", "less"});
  refused_closed(2, {1, 1, 1}, {"both 1", "length"});
  refused_closed(1, {0, 1, 1, 1, 2}, {"knot 1 is 1", "occurs 3 times"});
  refused_closed(1, {0, 0, 1, 2, 2}, {"occurs 3 times", "degree 1 at most 2"});
  const auto knots = Knots<double>::open(1, 3, {0, 0, 1, 2, 2});
  expect_error<InvalidParameter>([&] { knots.place(2.5); }, {"2.5", "outside the domain, 0 to 2"});
  expect_error<InvalidParameter>([&] { knots.place(-0.5); }, {"-0.5"});
  expect_error<InvalidParameter>([&] { knots.place(nan); }, {"nan"});
}

}  // namespace
}  // namespace sublimit::testing
