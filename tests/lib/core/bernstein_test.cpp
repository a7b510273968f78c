// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/bernstein.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "support/tolerance.h"
#include "truth/fraction.h"

namespace sublimit::testing {
namespace {

Bernstein<double> random_polynomial(PieceShape shape, int degree, unsigned seed) {
  std::mt19937 random(seed);
  Bernstein<double> f(shape, degree, degree);
  for (double& c : f.coefficients()) c = std::uniform_real_distribution<double>(0.5, 1)(random);
  return f;
}

// Coefficients of one sign, so that no terms cancel. From degree 18 on products of two binomial coefficients are larger
// than 32-bit integers.
TEST(Bernstein, ValuesOfProductsAreProductsOfValues) {
  for (const PieceShape shape : {PieceShape::square, PieceShape::triangle})
    for (const int degree : {1, 3, 9, 18}) {
      const Bernstein<double> f = random_polynomial(shape, degree, 1), g = random_polynomial(shape, 2 * degree, 2);
      const Bernstein<double> product = f * g;
      for (const double u : {0.0, 0.25, 0.4})
        for (const double v : {0.0, 0.3, 0.5}) {
          const double expected = f.at({u, v}) * g.at({u, v});
          EXPECT_NEAR(product.at({u, v}), expected, other_route * expected) << degree << " at " << u << ", " << v;
        }
      // Coefficients are means of products of those of the factors.
      EXPECT_GE(*std::ranges::min_element(product.coefficients()), 0.25 - other_route);
      EXPECT_LE(*std::ranges::max_element(product.coefficients()), 1 + other_route);
    }
}

TEST(Bernstein, VectorsOfCoefficientsAreOnePolynomialEach) {
  for (const PieceShape shape : {PieceShape::square, PieceShape::triangle})
    for (const int degree : {0, 1, 4}) {
      Bernstein<double, Eigen::Vector2d> f(shape, degree, degree);
      const Bernstein<double> x = random_polynomial(shape, degree, 3), y = random_polynomial(shape, degree, 4);
      for (size_t k = 0; k < x.coefficients().size(); ++k)
        f.coefficients()[k] << x.coefficients()[k], y.coefficients()[k];
      const PiecePlace<double> p{0.3, 0.4};
      EXPECT_EQ(f.at(p), Eigen::Vector2d(x.at(p), y.at(p)));
      EXPECT_EQ(f.du().at(p), Eigen::Vector2d(x.du().at(p), y.du().at(p)));
      EXPECT_EQ(f.dv().dv().at(p), Eigen::Vector2d(x.dv().dv().at(p), y.dv().dv().at(p)));
    }
}

// Beyond degree 33 they are larger than 32-bit integers; the sum of a row is 2^n.
TEST(Binomials, SumsOfRowsArePowersOfTwo) {
  for (const int n : {0, 1, 33, 34, 60}) {
    const std::vector<long double> row = binomials<long double>(n);
    EXPECT_EQ(std::accumulate(row.begin(), row.end(), 0.0L), std::ldexp(1.0L, n)) << n;
  }
  Fraction sum(0), power(1);
  for (const Fraction& c : binomials<Fraction>(40)) sum += c;
  for (int i = 0; i < 40; ++i) power *= 2;
  EXPECT_EQ(sum, power);
}

}  // namespace
}  // namespace sublimit::testing
