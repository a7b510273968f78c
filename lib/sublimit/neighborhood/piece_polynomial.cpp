// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/piece_polynomial.h"

#include <array>

namespace sublimit {
namespace {

constexpr int max_degree = 15;

/// T_0 ... T_degree of 2x - 1 with their first and second derivatives by x.
struct Chebyshev {
  std::array<double, max_degree + 1> value, first, second;
  Chebyshev(double x, int degree) {
    const double s = 2 * x - 1;
    value[0] = 1, first[0] = second[0] = 0;
    value[1] = s, first[1] = 2, second[1] = 0;
    for (int i = 2; i <= degree; ++i) {
      value[i] = 2 * s * value[i - 1] - value[i - 2];
      first[i] = 4 * value[i - 1] + 2 * s * first[i - 1] - first[i - 2];
      second[i] = 8 * first[i - 1] + 2 * s * second[i - 1] - second[i - 2];
    }
  }
};

}  // namespace

RowMatrix PolynomialBasis::at(double u, double v, int order) const {
  const Chebyshev a(u, degree_), b(v, degree_);
  RowMatrix rows(order == 0 ? 1 : order == 1 ? 3 : 6, size());
  int k = 0;
  for (int i = 0; i <= degree_; ++i)
    for (int j = 0; j <= (total_ ? degree_ - i : degree_); ++j, ++k) {
      rows(0, k) = a.value[i] * b.value[j];
      if (order < 1) continue;
      rows(1, k) = a.first[i] * b.value[j];
      rows(2, k) = a.value[i] * b.first[j];
      if (order < 2) continue;
      rows(3, k) = a.second[i] * b.value[j];
      rows(4, k) = a.first[i] * b.first[j];
      rows(5, k) = a.value[i] * b.second[j];
    }
  return rows;
}

}  // namespace sublimit
