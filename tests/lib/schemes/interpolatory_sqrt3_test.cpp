// SPDX-License-Identifier: Apache-2.0
// Labsik, Greiner 2000: spectrum over two steps, tangents, and what limits the regular case.
#include "sublimit/schemes/interpolatory_sqrt3.h"

#include <gtest/gtest.h>

#include <numbers>

#include "sublimit/schemes/schemes.h"
#include "truth/closed_form.h"

namespace sublimit::testing {
namespace {

using std::numbers::pi;

// What the weights are made for: A^2, A, A^2 in blocks 0, 1 and 2 of one step, A = 2/3 cos(pi/n), and nothing else; two
// steps square it. At n = 3 and 4 block 2 is block -1, or vanishes.
TEST(InterpolatorySqrt3, RingSpectrumMatchesTheClosedForm) {
  for (int n = 3; n <= 20; ++n) {
    if (n == 6) continue;
    const LocalSpectrum ring("interpolatory-sqrt3", n);
    const Precise lambda = 2 * (1 + cosine(1, n)) / 9;
    expect_eigenvalues(ring, 0, {1, lambda * lambda});
    for (int k = 1; k < n; ++k) {
      const int j = std::min(k, n - k);
      expect_eigenvalues(ring, k, {j == 1 ? lambda : j == 2 && n > 4 ? Precise(lambda * lambda) : Precise(0)});
    }
  }
}

TEST(InterpolatorySqrt3, LambdaIsAsTabulated) {
  expect_table("interpolatory-sqrt3", {.11111111, .22222222, .29089267, .33333333, .36077551, .37935706, .39245432,
                                       .40200378, .40916745, .41467231});
}

TEST(InterpolatorySqrt3, LimitIsTheVertexAndTangentsAreTheFirstMode) {
  for (int n = 3; n <= 20; ++n) {
    const IsolatedLimit limit = isolated_centre("interpolatory-sqrt3", n);
    Eigen::VectorXd vertex = Eigen::VectorXd::Unit(limit.masks.position.size(), 0);
    EXPECT_LE((limit.masks.position - vertex).norm(), closed_form) << n;
    if (n != 6) expect_first_mode(limit, n, 1);
    EXPECT_EQ(limit.masks.sides.at(0).plane, LimitMasks::Plane::yes) << n;
  }
}

// mu = lambda^2, but for n = 3, and n = 6, where block 0 has 0.180019 > 1/9: the exponent of regular meshes is at most
// -log_3 of it, 1.5608.
TEST(InterpolatorySqrt3, CurvatureRatiosAreAsTabulated) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum rings("interpolatory-sqrt3", n, 2);
    const double lambda = 2 * (1 + std::cos(2 * pi / n)) / 9, mu = rings.largest_below(lambda);
    if (n == 3) {
      EXPECT_NEAR(mu / (lambda * lambda), 1.650, three_decimals);
    } else if (n == 6) {
      EXPECT_NEAR(mu, .180019, six_decimals);
      EXPECT_NEAR(rings.leading(0), mu, closed_form);
      EXPECT_NEAR(-std::log(mu) / std::log(3), 1.5608, four_decimals);
    } else {
      EXPECT_NEAR(mu, lambda * lambda, closed_form) << n;
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
