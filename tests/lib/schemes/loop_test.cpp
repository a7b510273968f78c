// SPDX-License-Identifier: Apache-2.0
// Loop 1987 and Warren 1995: weights, spectra and curvature. Limit masks are in limit/limit_masks_test.cpp.
#include "sublimit/schemes/loop.h"

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

/// Total weight of the ring.
Precise beta(const std::string& name, int n) {
  const Precise a = ratio(3, 8) + cosine(1, n) / 4;
  return name == "loop" ? Precise(ratio(5, 8) - a * a) : n == 3 ? ratio(9, 16) : ratio(3, 8);
}

TEST(Loop, BetaIsTheTotalWeightOfTheRing) {
  EXPECT_NEAR(static_cast<double>(beta("loop", 3)), 9.0 / 16, eigen());
  EXPECT_NEAR(static_cast<double>(beta("loop", 6)), 3.0 / 8, eigen());
  for (const std::string name : {"loop", "loop-warren"})
    for (int n = 3; n <= 20; ++n) {
      const Eigen::MatrixXd S(refine(find_scheme(name).value(), fan(n, 3), 1)[1].S);
      const auto b = static_cast<double>(beta(name, n));
      EXPECT_NEAR(S(0, 0), 1 - b, rounding(4));
      for (int i = 0; i < n; ++i) EXPECT_NEAR(S(0, 1 + i), b / n, rounding(4));
    }
}

// Two rings: 3/8 + c_k/4, or 1 and 5/8 - beta, and from the second ring 1/8 and 1/16 in every block.
TEST(Loop, SpectrumOfTwoRingsMatchesTheClosedForm) {
  for (const std::string name : {"loop", "loop-warren"})
    for (int n = 3; n <= 20; ++n) {
      const LocalSpectrum rings(name, n, 2);
      expect_eigenvalues(rings, 0, {1, ratio(5, 8) - beta(name, n), ratio(1, 8), ratio(1, 16)});
      for (int k = 1; k < n; ++k)
        expect_eigenvalues(rings, k, {ratio(3, 8) + cosine(k, n) / 4, ratio(1, 8), ratio(1, 16)});
    }
}

TEST(Loop, LambdaIsAsTabulated) {
  for (const std::string name : {"loop", "loop-warren"})
    expect_table(name, {.25, .375, .45225425, .5, .53087245, .55177670, .56651111, .57725425, .58531338, .59150635});
}

// Loop's beta makes 5/8 - beta the square of lambda: bounded curvature at n = 4, 5 and 6, where block 2 is not larger.
// At n = 3 the 1/8 of the second ring is.
TEST(Loop, CurvatureRatiosAreAsTabulated) {
  const double loop[] = {2, 1, 1, 1, 1.133, 1.232}, warren[] = {2, 1.778, 1.222, 1, 1.133};
  for (int n = 3; n <= 20; ++n) {
    const double l = 3.0 / 8 + std::cos(2 * pi / n) / 4, saddle = 3.0 / 8 + std::cos(4 * pi / n) / 4;
    const double a = LocalSpectrum("loop", n, 2).largest_below(l);
    const double b = LocalSpectrum("loop-warren", n, 2).largest_below(l);
    EXPECT_NEAR(a, n == 3 ? 1.0 / 8 : std::max(l * l, saddle), closed_form) << n;
    EXPECT_NEAR(b, n == 3 ? 1.0 / 8 : std::max(1.0 / 4, saddle), closed_form) << n;
    if (n <= 8) {
      EXPECT_NEAR(a / (l * l), loop[n - 3], three_decimals) << n;
    }
    if (n <= 7) {
      EXPECT_NEAR(b / (l * l), warren[n - 3], three_decimals) << n;
    }
    if (n == 12) {
      EXPECT_NEAR(a / (l * l), 1.429, three_decimals);
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
