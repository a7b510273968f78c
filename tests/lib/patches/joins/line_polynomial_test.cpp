// SPDX-License-Identifier: Apache-2.0
// Polynomials along an edge: products against products of values, and signs that are decided.
#include "sublimit/patches/joins/line_polynomial.h"

#include <gtest/gtest.h>

#include <random>

#include "truth/fraction.h"

namespace sublimit::testing {
namespace {

using Line = LinePolynomial<Fraction>;

/// By Bernstein's sum.
Fraction value(const Line& f, const Fraction& t) {
  Fraction sum(0);
  const std::vector<Fraction> choose = binomials<Fraction>(std::max(f.degree(), 0));
  for (int i = 0; i <= f.degree(); ++i) {
    Fraction term = choose[size_t(i)] * f.coefficients()[size_t(i)];
    for (int k = 0; k < f.degree(); ++k) term *= k < i ? t : Fraction(1 - t);
    sum += term;
  }
  return sum;
}

Line random_line(std::mt19937& random, int degree) {
  std::vector<Fraction> c;
  for (int i = 0; i <= degree; ++i) c.push_back(Fraction(int(random() % 41) - 20) / 7);
  return Line(c);
}

TEST(LinePolynomial, SumsProductsAndDerivativesAreThoseOfItsValues) {
  std::mt19937 random(1);
  for (int repeat = 0; repeat < 40; ++repeat) {
    const Line f = random_line(random, int(random() % 7)), g = random_line(random, int(random() % 7));
    const Fraction t = Fraction(int(random() % 30)) / 11;
    EXPECT_EQ(value(f * g, t), value(f, t) * value(g, t));
    EXPECT_EQ(value(f + g, t), value(f, t) + value(g, t));
    EXPECT_EQ(value(f - g, t), value(f, t) - value(g, t));
    EXPECT_EQ(value(f.elevated(9), t), value(f, t));
    EXPECT_EQ(f.elevated(9).degree(), 9);
    EXPECT_EQ((f * g).degree(), f.degree() + g.degree());
    const auto [first, second] = f.halves();
    EXPECT_EQ(value(first, t), value(f, t / 2));
    EXPECT_EQ(value(second, t), value(f, (1 + t) / 2));
    // (f g)' = f' g + f g'
    EXPECT_EQ(value((f * g).derivative(), t), value(f.derivative() * g + f * g.derivative(), t));
  }
  EXPECT_EQ((Line() * random_line(random, 3)).degree(), -1);
  EXPECT_EQ((Line() + random_line(random, 3)).degree(), 3);
  EXPECT_TRUE((random_line(random, 3) * Line({Fraction(0), Fraction(0)})).is_zero());
}

/// (t - root), one factor each.
Line with_roots(const std::vector<Fraction>& roots) {
  Line f({Fraction(1)});
  for (const Fraction& root : roots) f = f * Line({Fraction(-root), Fraction(1 - root)});
  return f;
}

TEST(LinePolynomial, SignsAreDecided) {
  const Fraction third = Fraction(1) / 3, half = Fraction(1) / 2, near = Fraction(1) / 1000000;
  EXPECT_EQ(sign_between_ends(Line()), LineSign::zero);
  EXPECT_EQ(sign_between_ends(Line({Fraction(0), Fraction(0)})), LineSign::zero);
  EXPECT_EQ(sign_between_ends(Line({Fraction(-3)})), LineSign::negative);
  EXPECT_EQ(sign_between_ends(with_roots({third})), LineSign::changing);
  EXPECT_EQ(sign_between_ends(with_roots({half})), LineSign::changing);
  EXPECT_EQ(sign_between_ends(with_roots({third, third + near})), LineSign::changing);
  // Zeros at the ends, and beyond them.
  EXPECT_EQ(sign_between_ends(with_roots({0, 0, 1})), LineSign::negative);
  EXPECT_EQ(sign_between_ends(with_roots({0, 1, 1, -near})), LineSign::positive);
  EXPECT_EQ(sign_between_ends(with_roots({1 + near, 1 + near})), LineSign::positive);
  // Positive with coefficients of both signs: (t - 1/3)^2 + 1/1000000.
  EXPECT_EQ(sign_between_ends(with_roots({third, third}) + Line({near})), LineSign::positive);
  EXPECT_EQ(sign_between_ends(with_roots({third, third}) - Line({near})), LineSign::changing);
  // Zeros of even order: seen where halving meets them.
  EXPECT_EQ(sign_between_ends(with_roots({half, half})), LineSign::positive);
  EXPECT_EQ(sign_between_ends(with_roots({third, third})), LineSign::undecided);
}

TEST(LinePolynomial, SignsAreThoseOfItsValues) {
  std::mt19937 random(2);
  int changing = 0;
  for (int repeat = 0; repeat < 60; ++repeat) {
    const Line f = random_line(random, 1 + repeat % 9);
    bool found[2] = {false, false};
    for (int i = 1; i < 64; ++i) {
      const Fraction at = value(f, Fraction(i) / 64);
      if (at != 0) found[at < 0] = true;
    }
    const LineSign sign = sign_between_ends(f);
    if (found[0] && found[1]) {
      EXPECT_EQ(sign, LineSign::changing);
      ++changing;
    } else if (sign != LineSign::changing) {  // between the values there may be others
      EXPECT_EQ(sign, found[1] ? LineSign::negative : LineSign::positive);
    }
  }
  EXPECT_GT(changing, 10);
  EXPECT_LT(changing, 55);
}

}  // namespace
}  // namespace sublimit::testing
