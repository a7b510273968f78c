// SPDX-License-Identifier: Apache-2.0
// Masks as people type them: what a mask is does not depend on zeros around it.
#include "sublimit/certificates/regularity/typed_mask.h"

#include <gtest/gtest.h>

#include "sublimit/certificates/regularity/curve_regularity.h"

namespace sublimit {
namespace {

/// What the type of a mask is seen by: which coefficients the two masks have, and where.
void expect_same(const std::string& a, const std::string& b) {
  const Symbol x = typed_mask(a), y = typed_mask(b);
  EXPECT_EQ(x.first, y.first) << a << " and " << b;
  EXPECT_EQ(x.shift, y.shift) << a << " and " << b;
  EXPECT_EQ(x.coefficients, y.coefficients) << a << " and " << b;
}

TEST(TypedMask, ZerosAtTheEndsAreLeftOut) {
  expect_same("0 1 2 1 /2", "1 2 1 /2");
  expect_same("1 2 1 0 /2", "1 2 1 /2");
  expect_same("0 0 1 2 1 /2", "1 2 1 /2");
  expect_same("0 1 3 3 1 /4", "1 3 3 1 /4");
  expect_same("1/4 3/4 3/4 1/4 0 0 0", "1 3 3 1 /4");
  expect_same("0 -1 0 9 16 9 0 -1 /16", "-1 0 9 16 9 0 -1 /16");
}

TEST(TypedMask, IsInterpolatingIfOneMaskIsASingleOne) {
  for (const char* mask :
       {"1 2 1 /2", "0 1 2 1 /2", "1 2 1 0 /2", "0 0 1 2 1 /2", "-1 0 9 16 9 0 -1 /16", "0 0 -1 0 9 16 9 0 -1 /16",
        // Parabolas through three points, new ones between the first two.
        "3 8 6 0 -1 /8", "0 3 8 6 0 -1 /8"})
    EXPECT_TRUE(curve_regularity(typed_mask(mask)).interpolates) << mask;
  for (const char* mask : {"1 3 3 1 /4", "0 1 3 3 1 /4", "1 4 6 4 1 /8", "1 4 6 4 1 0 /8", "1 2 2 1 /3"})
    EXPECT_FALSE(curve_regularity(typed_mask(mask)).interpolates) << mask;
}

TEST(TypedMask, DualMasksStayDual) {
  EXPECT_EQ(typed_mask("1 3 3 1 /4").shift, Rational(1, 2));
  EXPECT_EQ(typed_mask("0 1 3 3 1 /4").shift, Rational(1, 2));
  EXPECT_EQ(typed_mask("1 4 6 4 1 /8").shift, Rational(0));
  EXPECT_EQ(typed_mask("0 1 4 6 4 1 /8").shift, Rational(0));
}

}  // namespace
}  // namespace sublimit
