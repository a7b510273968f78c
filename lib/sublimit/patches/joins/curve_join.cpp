// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/joins/curve_join.h"

#include <numeric>

namespace sublimit::curve_join_detail {

double length(const std::vector<double>& a) {
  double result = 0;
  for (const double x : a) result = std::hypot(result, x);
  return result;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) { return length(minus(a, 1.0, b)); }

double angle(const std::vector<double>& a, const std::vector<double>& b) {
  // Kahan: of unit vectors, exact for small and for large angles.
  std::vector<double> sum(a.size()), difference(a.size());
  const double of_a = length(a), of_b = length(b);
  for (size_t k = 0; k < a.size(); ++k) {
    sum[k] = a[k] / of_a + b[k] / of_b;
    difference[k] = a[k] / of_a - b[k] / of_b;
  }
  return 2 * std::atan2(length(difference), length(sum));
}

std::vector<double> curvature(const std::vector<double>& first, const std::vector<double>& second) {
  const double speed = length(first);
  std::vector<double> tangent;
  for (const double x : first) tangent.push_back(x / speed);
  const double along = std::inner_product(second.begin(), second.end(), tangent.begin(), 0.0);
  std::vector<double> result = minus(second, along, tangent);
  for (double& x : result) x /= speed * speed;
  return result;
}

}  // namespace sublimit::curve_join_detail
