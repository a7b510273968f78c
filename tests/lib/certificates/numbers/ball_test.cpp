// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/ball.h"

#include <gtest/gtest.h>

#include "sublimit/base/error.h"
#include "sublimit/certificates/numbers/complex_ball.h"

namespace sublimit {
namespace {

TEST(Ball, ComparesOnlyWhereItIsCertain) {
  const Ball third = Ball(1) / Ball(3);
  EXPECT_FALSE(third == third) << "a ball is not one number";
  EXPECT_FALSE(certainly_less(third, third));
  EXPECT_TRUE((third - third).contains_zero());
  EXPECT_TRUE(certainly_less(third, Ball(1) / Ball(2)));
  EXPECT_TRUE(Ball(3) / Ball(4) == Ball(0.75));
  EXPECT_FALSE((Ball(1) / (third - third)).is_finite());
}

TEST(Ball, TakesThePrecisionOfItsScope) {
  const Ball coarse = Ball(1) / Ball(3);
  const PrecisionScope scope(512);
  const Ball fine = Ball(1) / Ball(3);
  EXPECT_TRUE(coarse.contains(fine));
  constexpr double of_128_bits = 1e-40, of_512_bits = 1e-150;  // 2^-130 and 2^-510, roughly
  EXPECT_GT(coarse.radius(), of_128_bits);
  EXPECT_LT(fine.radius(), of_512_bits);
  EXPECT_LT(coarse.lower(), coarse.upper());
  EXPECT_TRUE(certainly_less(Ball(coarse.lower()), fine));
  EXPECT_TRUE(certainly_less(fine, Ball(coarse.upper())));
}

TEST(Ball, IsReadBackFromItsText) {
  const Ball x = Number<Ball>::cos_2pi(1, 7) - Ball(5);
  const Ball again = Ball::parse(x.exact_text());
  EXPECT_TRUE(arb_equal(x.get(), again.get()));
  const ComplexBall z = ComplexBall::root_of_unity(2, 7);
  EXPECT_TRUE(acb_equal(z.get(), ComplexBall::parse(z.exact_text()).get()));
  EXPECT_THROW(Ball::parse("a third"), FormatError);
  EXPECT_THROW(ComplexBall::parse(x.exact_text()), FormatError);
  EXPECT_THROW(intersection(Ball(1), Ball(2)), AnalysisError);
}

TEST(ComplexBall, RootsOfUnityHaveModulusOne) {
  for (int k = -3; k < 11; ++k) {
    const ComplexBall z = ComplexBall::root_of_unity(k, 11);
    EXPECT_TRUE((norm(z) - Ball(1)).contains_zero()) << k;
    EXPECT_TRUE((z.re() - Number<Ball>::cos_2pi(k, 11)).contains_zero()) << k;
    EXPECT_TRUE((z * conj(z) - ComplexBall(1)).contains_zero()) << k;
  }
}

}  // namespace
}  // namespace sublimit
