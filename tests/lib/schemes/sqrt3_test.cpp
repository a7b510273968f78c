// SPDX-License-Identifier: Apache-2.0
// Kobbelt 2000: relaxation, spectrum over two steps, limit masks.
#include "sublimit/schemes/sqrt3.h"

#include <gtest/gtest.h>

#include <numbers>

#include "meshes/meshes.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"
#include "truth/closed_form.h"

namespace sublimit::testing {
namespace {

using std::numbers::pi;

TEST(Sqrt3, OldVerticesAreRelaxed) {
  for (int n = 3; n <= 20; ++n) {
    const Eigen::MatrixXd S(refine(find_scheme("sqrt3").value(), fan(n, 3), 1)[1].S);
    const double a = (4 - 2 * std::cos(2 * pi / n)) / 9;
    EXPECT_NEAR(S(0, 0), 1 - a, rounding(4)) << n;
    for (int i = 0; i < n; ++i) EXPECT_NEAR(S(0, 1 + i), a / n, rounding(4)) << n;
  }
}

// Two steps, after which the ring lies as it did: 1 and (2/3 - a_n)^2, and (4/9) cos^2(pi k/n). The relaxation is the
// one that makes the second eigenvalue of block 0 the square of lambda.
TEST(Sqrt3, RingSpectrumMatchesTheClosedForm) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum ring("sqrt3", n);
    const Precise lambda = 2 * (1 + cosine(1, n)) / 9, rest = ratio(2, 3) - (4 - 2 * cosine(1, n)) / 9;
    expect_eigenvalues(ring, 0, {1, rest * rest});
    const Precise in_256_bits("1e-60");
    EXPECT_LE(abs(rest - lambda), in_256_bits) << n;
    for (int k = 1; k < n; ++k) expect_eigenvalues(ring, k, {2 * (1 + cosine(k, n)) / 9});
  }
}

TEST(Sqrt3, LambdaIsAsTabulated) {
  expect_table("sqrt3", {.11111111, .22222222, .29089267, .33333333, .36077551, .37935706, .39245432, .40200378,
                         .40916745, .41467231});
}

// Limit: centre 1/(1 + 3 a), neighbours 3 a/(n (1 + 3 a)); tangents are the first mode of the ring.
TEST(Sqrt3, LimitMasksMatchTheClosedForm) {
  for (int n = 3; n <= 20; ++n) {
    const IsolatedLimit limit = isolated_centre("sqrt3", n);
    const double a = (4 - 2 * std::cos(2 * pi / n)) / 9;
    ASSERT_EQ(limit.masks.position.size(), n + 1);
    EXPECT_NEAR(limit.masks.position[0], 1 / (1 + 3 * a), closed_form) << n;
    for (int i = 1; i <= n; ++i) EXPECT_NEAR(limit.masks.position[i], 3 * a / (n * (1 + 3 * a)), closed_form) << n;
    expect_first_mode(limit, n, 1);
    EXPECT_EQ(limit.masks.sides.at(0).plane, LimitMasks::Plane::yes) << n;
  }
  const IsolatedLimit regular = isolated_centre("sqrt3", 6);
  EXPECT_NEAR(regular.masks.position[0], 1.0 / 2, closed_form);
  EXPECT_NEAR(regular.masks.position[1], 1.0 / 12, closed_form);
}

// mu: at n = 3 from the second ring, lambda^2 at 4, 5 and 6, then block 2.
TEST(Sqrt3, CurvatureRatiosAreAsTabulated) {
  const double table[] = {3.323, 1, 1, 1, 1.327, 1.544};
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum rings("sqrt3", n, 2);
    const double lambda = 2 * (1 + std::cos(2 * pi / n)) / 9, saddle = 2 * (1 + std::cos(4 * pi / n)) / 9;
    const double mu = rings.largest_below(lambda);
    if (n > 3) {
      EXPECT_NEAR(mu, std::max(lambda * lambda, saddle), closed_form) << n;
    }
    if (n <= 8) {
      EXPECT_NEAR(mu / (lambda * lambda), table[n - 3], three_decimals) << n;
    }
    if (n == 12) {
      EXPECT_NEAR(mu / (lambda * lambda), 1.939, three_decimals);
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
