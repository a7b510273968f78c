// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/detail/polynomial.h"

#include <gtest/gtest.h>

#include "sublimit/base/error.h"
#include "sublimit/certificates/numbers/detail/algebraic_root.h"

namespace sublimit {
namespace {

Algebraic cosine(int k, int n) { return Number<Algebraic>::cos_2pi(k, n); }
Polynomial minus(const Algebraic& root) { return Polynomial({-root, 1}); }

TEST(Polynomial, FallsIntoSquarefreeFactors) {
  const Polynomial a = minus(cosine(1, 7)), b = Polynomial({cosine(1, 5), 0, 1});
  const std::vector<PolynomialFactor> factors = squarefree_factors(a * a * a * b);
  ASSERT_EQ(factors.size(), 2u);
  EXPECT_EQ(factors[0].factor, b);
  EXPECT_EQ(factors[0].multiplicity, 1);
  EXPECT_EQ(factors[1].factor, a);
  EXPECT_EQ(factors[1].multiplicity, 3);
  EXPECT_EQ(gcd(a * b, a * a), a);
  EXPECT_EQ(gcd(a, b).degree(), 0);
  EXPECT_EQ(Polynomial::parse((a * b).exact_text()), a * b);
  EXPECT_THROW(divide(a, Polynomial()), AnalysisError);
}

TEST(Polynomial, RootsAreEnclosedApart) {
  // Two roots 2^-90 apart, and a pair that is not real.
  const Algebraic near = 1 + Algebraic(0x1p-90);
  const Polynomial p = minus(1) * minus(near) * Polynomial({1, 0, 1});
  const std::vector<ComplexBall> roots = isolated_roots(p, 128);
  ASSERT_EQ(roots.size(), 4u);
  int real = 0, one = 0, other = 0;
  for (const ComplexBall& root : roots) {
    EXPECT_TRUE(p.at(root).contains_zero());
    real += acb_is_real(root.get());
    one += root.contains(ComplexBall(1));
    other += root.overlaps(near.enclosure());
  }
  EXPECT_EQ(real, 2);
  EXPECT_EQ(one, 1);
  EXPECT_EQ(other, 1);
}

TEST(Polynomial, OfAMatrixIsCharacteristic) {
  DenseMatrix<Algebraic> A(3, 3);
  A << 2, cosine(1, 5), 0, 1, Algebraic::ratio(1, 3), cosine(1, 8), 0, 4, -1;
  const Polynomial p = characteristic_polynomial(A);
  // By hand: x^3 - trace x^2 + sum of principal minors x - det.
  const Algebraic third = Algebraic::ratio(1, 3);
  const Algebraic minors = (2 * third - cosine(1, 5)) + Algebraic(-2) + (-third - 4 * cosine(1, 8));
  const Algebraic det = 2 * (-third - 4 * cosine(1, 8)) + cosine(1, 5);
  EXPECT_EQ(p, Polynomial({-det, minors, -(1 + third), 1}));
  DenseMatrix<Algebraic> R(3, 3);
  R << 1, 2, 3, 4, 5, 6, 7, 8, 10;
  EXPECT_EQ(characteristic_polynomial(R), Polynomial({3, -12, -16, 1})) << "the way over the rationals";
}

TEST(AlgebraicRoot, EqualitiesAndOrderAreDecided) {
  const std::vector<AlgebraicRoot> a = AlgebraicRoot::all(Polynomial({-2, 0, 1}));  // +-sqrt 2
  const std::vector<AlgebraicRoot> b = AlgebraicRoot::all(Polynomial({-2, 0, 1}) * minus(cosine(1, 7)));
  ASSERT_EQ(a.size(), 2u);
  ASSERT_EQ(b.size(), 3u);
  for (const AlgebraicRoot& x : a) {
    int equal = 0;
    for (const AlgebraicRoot& y : b) equal += x == y;
    EXPECT_EQ(equal, 1);
    EXPECT_EQ(x.squared(), AlgebraicRoot(Algebraic(2)));
    EXPECT_TRUE(x.is_real());
    EXPECT_EQ(x, AlgebraicRoot::nearest(x.polynomial(), x.enclosure()));
    // sqrt 2 lies in the field of the eighths: 2 cos(pi/4).
    EXPECT_TRUE(x == AlgebraicRoot(2 * cosine(1, 8)) || x == AlgebraicRoot(-2 * cosine(1, 8)));
  }
  EXPECT_FALSE(a[0] == a[1]);
  EXPECT_EQ(compare_moduli(a[0], a[1]), 0);
  EXPECT_NE(compare(a[0], a[1]), 0);
  EXPECT_EQ(a[0] * a[1], AlgebraicRoot(Algebraic(-2)));
  // sqrt 2 against a number that differs from it in the 200th digit.
  const std::vector<AlgebraicRoot> near = AlgebraicRoot::all(Polynomial({Algebraic(-2) - Algebraic(0x1p-700), 0, 1}));
  EXPECT_EQ(compare_moduli(a[0], near[0]), -1);
  EXPECT_FALSE(a[0] == near[0]);
  const Polynomial two({-2, 0, 1});
  int zeros = 0;
  const Polynomial almost_two({Algebraic(-2) - Algebraic(0x1p-132), 0, 1});
  for (const AlgebraicRoot& root : AlgebraicRoot::all(two * almost_two)) zeros += root.is_root_of(two);
  EXPECT_EQ(zeros, 2) << "of four roots, two and two that are next to each other";
  // A pair of modulus 3 that is not real, and -3.
  const std::vector<AlgebraicRoot> pair = AlgebraicRoot::all(Polynomial({9, 1, 1}));
  EXPECT_FALSE(pair[0].is_real());
  EXPECT_EQ(pair[0], pair[1].conj());
  EXPECT_EQ(compare_moduli(pair[0], AlgebraicRoot(Algebraic(-3))), 0);
}

}  // namespace
}  // namespace sublimit
