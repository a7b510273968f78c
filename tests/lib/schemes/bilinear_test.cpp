// SPDX-License-Identifier: Apache-2.0
// Bilinear subdivision: nothing moves, so the spectrum is all there is to know.
#include "sublimit/schemes/bilinear.h"

#include <gtest/gtest.h>

#include "truth/closed_form.h"

namespace sublimit::testing {
namespace {

// New ring points are (v + e)/2 and (v + e_i + e_(i+1) + f)/4: no valence shrinks differently from another.
TEST(Bilinear, RingShrinksByHalvesAndQuartersAtEveryValence) {
  for (int n = 3; n <= 20; ++n) {
    const LocalSpectrum ring("bilinear", n);
    expect_eigenvalues(ring, 0, {1, ratio(1, 2), ratio(1, 4)});
    for (int k = 1; k < n; ++k) expect_eigenvalues(ring, k, {ratio(1, 2), ratio(1, 4)});
  }
}

}  // namespace
}  // namespace sublimit::testing
