// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/detail/rational_number.h"

#include <gtest/gtest.h>

#include <limits>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

TEST(Rational, HasAsManyDigitsAsItNeeds) {
  Rational third(1, 3), power = 1;
  for (int k = 0; k < 100; ++k) power *= third;
  EXPECT_EQ(to_string(power), "1/515377520732011331036461129765621272702107522001");  // 3^100: 159 bits
  for (int k = 0; k < 100; ++k) power /= third;
  EXPECT_EQ(power, Rational(1));
  EXPECT_EQ(to_string(Rational(6, -8)), "-3/4");
  EXPECT_EQ(to_string(Rational(1, std::numeric_limits<long>::min())), "-1/9223372036854775808");
  EXPECT_EQ(to_string(Rational(Ratio{4, 2})), "2");
  EXPECT_EQ(to_string(Rational(std::numeric_limits<unsigned long>::max())), "18446744073709551615");
}

TEST(Rational, OfDoublesIsExact) {
  EXPECT_EQ(Rational(0.375), Rational(3, 8));
  EXPECT_EQ(Rational(-0x1p70), -Rational(1L << 35) * Rational(1L << 35));
  for (const double x : {0.1, -1e300, 5e-324, 0.0}) EXPECT_EQ(Rational(x).value(), x);
  EXPECT_THROW(Rational(std::numeric_limits<double>::quiet_NaN()), InvalidMesh);
}

TEST(Rational, IsEnclosed) {
  const Ball third = Rational(1, 3).enclosure();
  EXPECT_TRUE((Ball(3) * third).contains(Ball(1)));
  EXPECT_LT(third.lower(), third.upper());
  EXPECT_EQ(Rational(3, 4).enclosure().lower(), Rational(3, 4).enclosure().upper());
}

TEST(Rational, IrrationalNumbersAreEqualToNothing) {
  const Rational root = sqrt(Rational(2)), pentagon = Number<Rational>::cos_2pi(1, 5);
  EXPECT_FALSE(root.is_ratio());
  EXPECT_FALSE((pentagon * 0).is_ratio());
  EXPECT_FALSE(root == root || root < pentagon || root > pentagon || root == Rational(0));
  EXPECT_FALSE(root.is_zero());
  EXPECT_FALSE(root.enclosure().is_finite());
  EXPECT_EQ(to_string(root), "irrational");
  EXPECT_EQ(sqrt(Rational(9, 16)), Rational(3, 4));
  EXPECT_EQ(Number<Rational>::cos_2pi(-2, 6), Rational(-1, 2));
}

TEST(Rational, HasNoQuotientByZero) {
  EXPECT_THROW(Rational(1, 0), AnalysisError);
  EXPECT_THROW(Rational(1) / Rational(0), AnalysisError);
}

}  // namespace
}  // namespace sublimit
