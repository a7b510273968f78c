// SPDX-License-Identifier: Apache-2.0
#include "sublimit/refine.h"

#include <gtest/gtest.h>

#include "sublimit/base/error.h"
#include "sublimit/schemes.h"
#include "sublimit/sparse_product.h"
#include "support/meshes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

const Scheme<double> catmull_clark_scheme = find_scheme("catmull-clark").value();

// Corner (1,1,1) of the cube: n = 3, (n-2)/n v = 1/3, neighbours' mean (1,1,-1)+.. = 1/3 each, face centroids' mean 1/3 each:
// (1 + 1/3 + 1/3) / 3 = 5/9. An edge point: (0, 1, 1) with face points (0,1,0) and (0,0,1): 3/4. A face point: 1.
TEST(Refine, CubeCornerIsAtFiveNinths) {
  const std::vector<Level> levels = refine(catmull_clark_scheme, cube(), 1);
  const Points x = apply(levels[1].S, cube().positions);
  for (Index v = 0; v < 8; ++v)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(std::abs(x(v, c)), 5.0 / 9, rounding(7));
  for (Index f = 0; f < 6; ++f) EXPECT_NEAR(x.row(8 + f).cwiseAbs().maxCoeff(), 1, rounding(4));
  for (Index e = 0; e < 12; ++e) EXPECT_NEAR(x.row(14 + e).cwiseAbs().maxCoeff(), 0.75, rounding(6));
}

}  // namespace
}  // namespace sublimit::testing
