// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/detail/ball_matrix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sublimit/certificates/regularity/joint_spectral_radius.h"
#include "sublimit/certificates/regularity/smoothness.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(BallMatrix, OfWhatIsNoNumberHasNoBound) {
  // Nothing compares with NaN: a maximum over rows that skips it would call the matrix small.
  Eigen::MatrixXd A = 0.25 * Eigen::MatrixXd::Identity(2, 2);
  A(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(maximum_norm(BallMatrix(A)).upper(), infinity);
  EXPECT_EQ(euclidean_norm(BallMatrix(A)), infinity);
  EXPECT_EQ(spectral_radius_below(BallMatrix(A)), 0);
  EXPECT_EQ(norm_bound({BallMatrix(A)}, Eigen::MatrixXd::Identity(2, 2)), infinity);
}

TEST(BallMatrix, EnclosesTheNormOfThirds) {
  RationalMatrix A(1, 3);
  for (int j = 0; j < 3; ++j) A(0, j) = Number<Rational>::ratio(j == 1 ? -1 : 1, 3);
  const Ball norm = maximum_norm(BallMatrix(A));
  EXPECT_LE(norm.lower(), 1);
  EXPECT_GE(norm.upper(), 1);
  EXPECT_LT(norm.upper() - norm.lower(), testing::rounding(1));
}

TEST(BallMatrix, SpectraAreBoundedOnTheRightSide) {
  // A Jordan block: doubles split its eigenvalue by 1e-8. Its norm is the golden ratio: |A|^2 = (3 + sqrt 5)/2.
  Eigen::Matrix2d A;
  A << 1, 1, 0, 1;
  const double radius = spectral_radius_below(BallMatrix(A)), norm = euclidean_norm(BallMatrix(A));
  EXPECT_LE(radius, 1);
  EXPECT_GT(radius, 1 - 1e-8);  // traces: 2^(1/2^30) is all that is lost
  const double golden = (1 + std::sqrt(5)) / 2;
  EXPECT_GE(norm, golden);
  EXPECT_LT(norm, golden + testing::other_route);
  EXPECT_LT(euclidean_norm(BallMatrix(Eigen::MatrixXd(Eigen::MatrixXd::Zero(2, 2)))), testing::eps);
  EXPECT_EQ(product_radius({BallMatrix(Eigen::MatrixXd::Constant(1, 1, 0.125))}, {0, 0, 0}), 0.125);
}

TEST(BallMatrix, InversesAreCertain) {
  Eigen::Matrix2d A;
  A << 1, 2, 3, 4;
  const auto inverse = BallMatrix(A).inverse();
  ASSERT_TRUE(inverse);
  EXPECT_TRUE((*inverse)(0, 0).contains(Ball(-2)));
  EXPECT_TRUE((*inverse)(1, 0).contains(Ball(1.5)));
  A << 1, 2, 2, 4;
  EXPECT_FALSE(BallMatrix(A).inverse());
}

}  // namespace
}  // namespace sublimit
