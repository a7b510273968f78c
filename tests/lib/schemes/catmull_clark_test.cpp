// SPDX-License-Identifier: Apache-2.0
// Catmull, Clark 1978: weights, spectra and curvature as in Ball, Storry 1988 and Reif, Schroeder 2001. Limit masks are
// in limit/limit_masks_test.cpp.
#include "sublimit/schemes/catmull_clark.h"

#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"
#include "truth/closed_form.h"

namespace sublimit::testing {
namespace {

Precise lambda(int k, int n, int sign) {
  const Precise c = cosine(k, n);
  return (5 + c + sign * sqrt((c + 1) * (c + 9))) / 16;
}
/// Of block 0, without the 1.
Precise central(int n, int sign) { return (3 * n - 7 + sign * sqrt(Precise(5 * n * n - 30 * n + 49))) / (8 * n); }

// On quads V = (1 - 7/(4n)) v + 3/(2 n^2) sum e_i + 1/(4 n^2) sum f_i.
TEST(CatmullClark, VertexWeightsOnQuadsAreTheClosedForm) {
  for (int n = 3; n <= 20; ++n) {
    const Eigen::MatrixXd S(refine(find_scheme("catmull-clark").value(), fan(n), 1)[1].S);
    EXPECT_NEAR(S(0, 0), 1 - 7 / (4.0 * n), rounding(4));
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(S(0, 1 + 2 * i), 1.5 / (n * n), rounding(4));
      EXPECT_NEAR(S(0, 2 + 2 * i), 0.25 / (n * n), rounding(4));
    }
  }
}

// Two rings: the eigenvalues of one and, from the regular points of the second, 1/8, 1/16, 1/32 and 1/64 in every
// block.
TEST(CatmullClark, SpectrumOfTwoRingsMatchesTheClosedForm) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum rings("catmull-clark", n, 2);
    const Precise outer[] = {ratio(1, 8), ratio(1, 16), ratio(1, 32), ratio(1, 64)};
    for (int k = 0; k < n; ++k) {
      std::vector<Precise> expected(std::begin(outer), std::end(outer));
      if (k == 0) expected.push_back(1);
      for (const int sign : {-1, 1}) expected.push_back(k == 0 ? central(n, sign) : lambda(k, n, sign));
      expect_eigenvalues(rings, k, expected);
    }
  }
}

TEST(CatmullClark, LambdaIsAsTabulated) {
  expect_table("catmull-clark",
               {.41009705, .5, .54998835, .57968233, .59851028, .61111653, .61993922, .62634127, .63112759, .63479641});
}

// mu/lambda^2: from block 0 at n = 3 (flat), one at n = 4 (curvature is continuous), from block 2 beyond (it diverges).
TEST(CatmullClark, CurvatureIsBoundedAtValencesThreeAndFourOnly) {
  const double table[] = {.9910, 1, 1.124, 1.220, 1.289, 1.339};
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum rings("catmull-clark", n, 2);
    const auto square = static_cast<double>(lambda(1, n, 1) * lambda(1, n, 1));
    const double mu = rings.largest_below(static_cast<double>(lambda(1, n, 1)));
    EXPECT_NEAR(mu, static_cast<double>(n == 3 ? central(3, 1) : lambda(2, n, 1)), closed_form) << n;
    if (n <= 8) {
      EXPECT_NEAR(mu / square, table[n - 3], three_decimals) << n;
    }
    if (n == 12) {
      EXPECT_NEAR(mu / square, 1.439, three_decimals);
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
