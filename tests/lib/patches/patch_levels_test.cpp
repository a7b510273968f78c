// SPDX-License-Identifier: Apache-2.0
// Sizes of levels, told before they are made.
#include "sublimit/patches/detail/patch_levels.h"

#include <gtest/gtest.h>

#include "sublimit/base/detail/memory.h"
#include "sublimit/patches/constructions/triangle_patch.h"
#include "sublimit/patches/spline_surface.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

PatchSet set_of(std::shared_ptr<const Patch> patch) {
  return PatchSet(std::vector<std::shared_ptr<const Patch>>{std::move(patch)});
}

PatchSet bezier_set(int p, int q) {
  return set_of(std::make_shared<const SplineSurface>(bezier_knots<double>(p), bezier_knots<double>(q)));
}

TEST(PatchLevels, HaveTheSizesThatWereTold) {
  for (const auto& [p, q] : {std::pair(3, 3), {2, 2}, {1, 1}, {1, 3}, {5, 2}}) {
    SCOPED_TRACE(p * 10 + q);
    const PatchSet coarse = bezier_set(p, q);
    PatchSet fine = coarse;
    for (int k = 1; k <= 4; ++k) {
      auto [next, S] = fine.refined();
      const PatchLevelSize size = level_size(coarse, k);
      // Equal for equal directions, else a lower bound that is near.
      EXPECT_LE(size.points, double(next.num_points()) * (1 + rounding(4)));
      EXPECT_GE(size.points, 0.9 * double(next.num_points()));
      if (p == q) {
        EXPECT_NEAR(size.points, double(next.num_points()), rounding(4, double(next.num_points())));
      }
      // Rows near the ends are narrower, and soon few.
      if (k == 4) {
        EXPECT_LE(size.nonzeros, 1.5 * double(S.nonZeros()));
        EXPECT_GE(size.nonzeros, 0.75 * double(S.nonZeros()));
      }
      fine = std::move(next);
    }
  }
  const PatchSet triangle = set_of(std::make_shared<const TrianglePatch>(3));
  PatchSet fine = triangle;
  for (int k = 1; k <= 3; ++k) {
    fine = fine.refined().first;
    EXPECT_GE(level_size(triangle, k).points, double(fine.num_points()));
    EXPECT_LE(level_size(triangle, k).points, 3 * double(fine.num_points()));
  }
}

TEST(PatchLevels, BeyondIndicesOrMemoryAreRefused) {
  const PatchSet patches = bezier_set(3, 3);
  check_levels(patches, 0);
  check_levels(patches, 5, true);
  expect_error<InvalidParameter>([&] { check_levels(patches, -1); }, {"levels is -1"});
  for (const int levels : {20, 1000})
    expect_error<ResourceError>([&] { check_levels(patches, levels); },
                                {std::to_string(levels) + " levels of 1 faces", "use at most "});
  struct Unlimited {
    ~Unlimited() { limit_memory(std::numeric_limits<double>::infinity()); }
  } const unlimited;
  // Level 3 has 11 x 11 points of about 340 bytes.
  limit_memory(60e3);
  check_levels(patches, 3);
  expect_error<ResourceError>([&] { check_levels(patches, 4); }, {"4 levels", "the limit is 60.0 KB", "use at most 3"});
  limit_memory(1e3);
  expect_error<ResourceError>([&] { check_levels(patches, 1); }, {"the limit is 1.0 KB", "use fewer patches"});
}

}  // namespace
}  // namespace sublimit::testing
