// SPDX-License-Identifier: Apache-2.0
// The blossom in exact fractions: what defines it, and the classical algorithms that follow from it.
#include "sublimit/patches/detail/blossom.h"

#include <gtest/gtest.h>

#include <numeric>

#include "truth/classical_splines.h"
#include "truth/fraction.h"

namespace sublimit::testing {
namespace {

using Argument = BlossomArgument<Fraction>;
using Row = std::vector<Fraction>;

Row weights(const Knots<Fraction>& knots, Index face, const std::vector<Argument>& arguments) {
  Row row(arguments.size() + 1);
  blossom(knots.all(), knots.span(face), std::span<const Argument>(arguments), std::span<Fraction>(row));
  return row;
}
Row weights_at(const Knots<Fraction>& knots, Index face, const Row& points) {
  std::vector<Argument> arguments;
  for (const Fraction& t : points) arguments.push_back(Argument::point(t));
  return weights(knots, face, arguments);
}

/// Random points, some of them outside the domain.
Row random_arguments(std::mt19937& random, int count) {
  std::uniform_int_distribution<int> draw(-90, 90);
  Row points;
  for (int i = 0; i < count; ++i) points.push_back(Fraction(draw(random)) / 7);
  return points;
}

template <class Law>
void for_random_pieces(const Law& law) {
  std::mt19937 random(1);
  for (int degree = 1; degree <= 9; ++degree)
    for (int repeat = 0; repeat < 12; ++repeat) {
      const Knots<Fraction> knots = random_knots<Fraction>(random, degree, repeat % 3 == 2);
      for (Index face = 0; face < knots.num_faces(); ++face) law(random, knots, face);
    }
}

TEST(Blossom, IsSymmetric) {
  for_random_pieces([](std::mt19937& random, const Knots<Fraction>& knots, Index face) {
    Row points = random_arguments(random, knots.degree());
    const Row row = weights_at(knots, face, points);
    std::shuffle(points.begin(), points.end(), random);
    EXPECT_EQ(weights_at(knots, face, points), row);
  });
}

TEST(Blossom, IsAffineInEveryArgument) {
  for_random_pieces([](std::mt19937& random, const Knots<Fraction>& knots, Index face) {
    Row points = random_arguments(random, knots.degree());
    const Row ends = random_arguments(random, 3);
    const size_t which = random() % points.size();
    const auto at = [&](const Fraction& t) {
      points[which] = t;
      return weights_at(knots, face, points);
    };
    const Row a = at(ends[0]), b = at(ends[1]), between = at((1 - ends[2]) * ends[0] + ends[2] * ends[1]);
    for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(between[i], (1 - ends[2]) * a[i] + ends[2] * b[i]);
  });
}

TEST(Blossom, AtConsecutiveKnotsIsAControlPoint) {
  for_random_pieces([](std::mt19937&, const Knots<Fraction>& knots, Index face) {
    const Index p = knots.degree(), k = knots.span(face);
    for (Index i = k - p; i <= k; ++i) {
      Row unit(p + 1, Fraction(0));
      unit[i - (k - p)] = 1;
      const std::span<const Fraction> at = knots.all().subspan(i + 1, p);
      EXPECT_EQ(weights_at(knots, face, Row(at.begin(), at.end())), unit);
    }
  });
}

TEST(Blossom, OnTheDiagonalIsCoxDeBoorAndDeBoor) {
  for_random_pieces([](std::mt19937& random, const Knots<Fraction>& knots, Index face) {
    const Index p = knots.degree(), k = knots.span(face);
    const Fraction t = knots.parameter({face, Fraction(static_cast<int>(random() % 8)) / 7});
    const Row row = weights_at(knots, face, Row(p, t));
    EXPECT_EQ(std::accumulate(row.begin(), row.end(), Fraction(0)), 1);
    const Row points = random_arguments(random, p + 1);
    Fraction sum(0);
    for (Index i = 0; i <= p; ++i) {
      EXPECT_EQ(row[i], cox_de_boor(knots.all(), k, k - p + i, p, t));
      EXPECT_GE(row[i], 0);
      sum += row[i] * points[i];
    }
    EXPECT_EQ(sum, de_boor(knots.all(), k, points, t));
  });
}

TEST(Blossom, OfADirectionIsADifferenceOfPoints) {
  for_random_pieces([](std::mt19937& random, const Knots<Fraction>& knots, Index face) {
    const Row points = random_arguments(random, knots.degree());
    std::vector<Argument> arguments;
    for (const Fraction& t : points) arguments.push_back(Argument::point(t));
    const size_t which = random() % points.size();
    const Fraction d = random_arguments(random, 1)[0];
    const Row from = weights(knots, face, arguments);
    arguments[which] = Argument::point(points[which] + d);
    Row to = weights(knots, face, arguments);
    arguments[which] = Argument::direction(d);
    for (size_t i = 0; i < to.size(); ++i) to[i] -= from[i];
    EXPECT_EQ(weights(knots, face, arguments), to);
  });
}

TEST(Blossom, TakesPointsByTheirDistancesToKnots) {
  for_random_pieces([](std::mt19937&, const Knots<Fraction>& knots, Index face) {
    const Fraction a = knots.all()[knots.span(face)], b = knots.all()[knots.span(face) + 1], u(3, 11);
    EXPECT_EQ(weights(knots, face, std::vector<Argument>(knots.degree(), Argument::between(a, b, u))),
              weights_at(knots, face, Row(knots.degree(), (1 - u) * a + u * b)));
  });
}

}  // namespace
}  // namespace sublimit::testing
