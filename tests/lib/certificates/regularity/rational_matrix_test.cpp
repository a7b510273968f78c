// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/rational_matrix.h"

#include <gtest/gtest.h>

namespace sublimit {
namespace {

/// 1/(i + j + 1): regular, though doubles lose all digits of its inverse from n = 13 on.
RationalMatrix hilbert(int n) {
  RationalMatrix H(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) H(i, j) = Rational(1, i + j + 1);
  return H;
}

TEST(RationalMatrix, SingularityIsDecided) {
  RationalMatrix H = hilbert(20);
  EXPECT_FALSE(is_singular(H));
  H.row(19) = H.row(0) + H.row(1);
  EXPECT_TRUE(is_singular(H));
  H(19, 19) += Rational(0x1p-200);
  EXPECT_FALSE(is_singular(H));
}

TEST(RationalMatrix, ReducedRowsSolve) {
  // The right side is H times (1, 2 .. n).
  constexpr int n = 15;
  RationalMatrix M(n, n + 1);
  M.leftCols(n) = hilbert(n);
  for (int i = 0; i < n; ++i) {
    M(i, n) = 0;
    for (int j = 0; j < n; ++j) M(i, n) += M(i, j) * (j + 1);
  }
  EXPECT_EQ(reduce_rows(M).size(), size_t{n});
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) EXPECT_EQ(M(i, j), Rational(i == j));
    EXPECT_EQ(M(i, n), Rational(i + 1));
  }
  RationalMatrix low(2, 3);
  low << 0, 2, 4, 0, 3, 6;
  EXPECT_EQ(reduce_rows(low), std::vector<Eigen::Index>{1});
  EXPECT_EQ(low(0, 2), Rational(2));
}

}  // namespace
}  // namespace sublimit
