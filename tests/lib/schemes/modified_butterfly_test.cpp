// SPDX-License-Identifier: Apache-2.0
// Zorin, Schroeder, Sweldens 1996: the spectrum that the special rules are made for, and tangents.
#include "sublimit/schemes/modified_butterfly.h"

#include <gtest/gtest.h>

#include "sublimit/schemes/schemes.h"
#include "truth/closed_form.h"

namespace sublimit::testing {
namespace {

// One ring is closed: 1/4 in block 0, 1/2 in blocks 1 and -1, 1/4 in blocks 2 and -2 (merged at n = 4), nothing else.
TEST(ModifiedButterfly, RingSpectrumMatchesTheClosedForm) {
  for (int n = 3; n <= 20; ++n) {
    if (n == 6) continue;
    const LocalSpectrum ring("modified-butterfly", n);
    expect_eigenvalues(ring, 0, {1, ratio(1, 4)});
    for (int k = 1; k < n; ++k) {
      const int j = std::min(k, n - k);
      expect_eigenvalues(ring, k, {j == 1 ? ratio(1, 2) : j == 2 ? ratio(1, 4) : Precise(0)});
    }
  }
}

// With more rings nothing larger than 1/4 appears besides lambda = 1/2, and 1/4 has all its eigenvectors, but for n =
// 6, which is the butterfly's own rule.
TEST(ModifiedButterfly, QuarterIsNextAndSemisimple) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum rings("modified-butterfly", n, 2);
    EXPECT_NEAR(rings.leading(1), 0.5, closed_form) << n;
    EXPECT_NEAR(rings.largest_below(0.5), 0.25, closed_form) << n;
    for (int k = 0; k < n; ++k) {
      const std::vector<int> steps = rings.staircase(k, ratio(1, 4));
      if (n != 6) {
        EXPECT_LE(steps.size(), 1u) << n << " block " << k;
      }
      if (n == 6 && k == 0) {
        EXPECT_EQ(steps, (std::vector<int>{1, 2, 3}));
      }
    }
  }
}

TEST(ModifiedButterfly, LimitIsTheVertexAndTangentsAreTheFirstMode) {
  for (int n = 3; n <= 20; ++n) {
    const IsolatedLimit limit = isolated_centre("modified-butterfly", n);
    const Eigen::VectorXd vertex = Eigen::VectorXd::Unit(limit.masks.position.size(), 0);
    EXPECT_LE((limit.masks.position - vertex).norm(), closed_form) << n;
    if (n != 6) expect_first_mode(limit, n, 1);
    EXPECT_NEAR(limit.masks.sides.at(0).lambda1, 0.5, closed_form) << n;
    EXPECT_EQ(limit.masks.sides.at(0).plane, LimitMasks::Plane::yes) << n;
  }
}

}  // namespace
}  // namespace sublimit::testing
