// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/power_coefficients.h"

#include <Eigen/Core>

namespace sublimit {

std::vector<double> blossoms_of_powers(std::span<const double> arguments, int highest) {
  // The mean of the products of k arguments, over the first m of them, from those over the first m - 1: a new argument
  // is in k of m of the products.
  std::vector<long double> means(static_cast<size_t>(highest) + 1, 0);
  means[0] = 1;
  for (size_t m = 1; m <= arguments.size(); ++m)
    for (size_t k = std::min<size_t>(m, static_cast<size_t>(highest)); k > 0; --k) {
      const long double share = static_cast<long double>(k) / static_cast<long double>(m);
      means[k] = (1 - share) * means[k] + share * arguments[m - 1] * means[k - 1];
    }
  return {means.begin(), means.end()};
}

Eigen::MatrixXd polynomial_points(const Knots<double>& knots, const Eigen::MatrixXd& coefficients) {
  const int p = knots.degree(), highest = static_cast<int>(coefficients.cols()) - 1;
  assert(highest <= p && !knots.is_closed());
  Eigen::MatrixXd points(knots.num_points(), coefficients.rows());
  for (Index i = 0; i < knots.num_points(); ++i) {
    const std::vector<double> powers = blossoms_of_powers(knots.all().subspan(size_t(i) + 1, size_t(p)), highest);
    points.row(i) = coefficients * Eigen::Map<const Eigen::VectorXd>(powers.data(), highest + 1);
  }
  return points;
}

Eigen::Matrix4d hermite_coefficients() {
  Eigen::Matrix4d F;
  F << 1, 0, -3, 2,  //
      0, 0, 3, -2,   //
      0, 1, -2, 1,   //
      0, 0, -1, 1;
  return F;
}

Eigen::Matrix4d hermite_to_bezier() { return polynomial_points(bezier_knots<double>(3), hermite_coefficients()); }

}  // namespace sublimit
