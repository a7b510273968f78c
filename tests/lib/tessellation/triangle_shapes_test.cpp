// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/detail/triangle_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/tolerance.h"

namespace sublimit {
namespace {

using testing::rounding;

TEST(TriangleShapes, AspectRatiosAreThoseOfTheDefinition) {
  const double root3 = std::sqrt(3.0);
  EXPECT_NEAR(aspect_ratio({0, 0, 0}, {2, 0, 0}, {1, root3, 0}), 2 / root3, rounding(8));  // sides 2, height sqrt(3)
  EXPECT_EQ(aspect_ratio({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 2);                             // sqrt(2) over 1/sqrt(2)
  EXPECT_EQ(aspect_ratio({0, 0, 0}, {0, 0, 8}, {0, 1, 4}), 8);                             // 8 over 1
  EXPECT_EQ(aspect_ratio({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), HUGE_VAL);
}

TEST(TriangleShapes, CountsTrianglesWithoutAnArea) {
  Tessellation made;
  made.points = (Points(5, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0, 8, 0, 0, 4, 1, 0).finished();
  EXPECT_EQ(triangle_shapes(made).largest_aspect, 0);
  for (const std::array<Index, 3>& vertices : {std::array<Index, 3>{0, 1, 2}, std::array<Index, 3>{0, 1, 2},
                                               std::array<Index, 3>{0, 3, 4}, std::array<Index, 3>{0, 1, 3}})
    made.triangles.push_back({0, vertices, {}});
  const TriangleShapes shapes = triangle_shapes(made);
  EXPECT_EQ(shapes.without_area, 1);
  EXPECT_EQ(shapes.median_aspect, 2);
  EXPECT_EQ(shapes.largest_aspect, 8);
}

}  // namespace
}  // namespace sublimit
