// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/bernstein.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/tolerance.h"

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

}  // namespace
}  // namespace sublimit::testing
