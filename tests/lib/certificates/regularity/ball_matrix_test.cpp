// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/ball_matrix.h"

#include <gtest/gtest.h>

#include <limits>

#include "sublimit/certificates/regularity/joint_spectral_radius.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(BallMatrix, OfWhatIsNoNumberHasNoBound) {
  // Nothing compares with NaN: a maximum over rows that skips it would call the matrix small.
  Eigen::MatrixXd A = 0.25 * Eigen::MatrixXd::Identity(2, 2);
  A(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(maximum_norm(BallMatrix(A)).high, infinity);
  EXPECT_EQ(spectral_radius(BallMatrix(A)).high, infinity);
  EXPECT_EQ(norm_bound({BallMatrix(A)}, Eigen::MatrixXd::Identity(2, 2)), infinity);
}

TEST(BallMatrix, EnclosesTheNormOfThirds) {
  Eigen::Matrix<Rational, Eigen::Dynamic, Eigen::Dynamic> A(1, 3);
  for (int j = 0; j < 3; ++j) A(0, j) = Number<Rational>::ratio(j == 1 ? -1 : 1, 3);
  const Interval norm = maximum_norm(BallMatrix(A));
  EXPECT_LE(norm.low, 1);
  EXPECT_GE(norm.high, 1);
  EXPECT_LT(norm.high - norm.low, testing::rounding(8));
}

}  // namespace
}  // namespace sublimit
