// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/ball_matrix.h"

#include <Eigen/LU>

#include <cmath>

namespace sublimit {
namespace {

constexpr double eps = 0x1p-53, tiny = 0x1p-1000, infinity = std::numeric_limits<double>::infinity();

/// 2^x rounded outwards; the library's is taken to be right within two units in the last place.
double power_of_two(double x, int side) {
  double y = std::exp2(x);
  if (x == std::floor(x)) return y;
  for (int i = 0; i < 4; ++i) y = std::nextafter(y, side * infinity);
  return y;
}

}  // namespace

BallMatrix::BallMatrix(const Eigen::Matrix<Rational, Eigen::Dynamic, Eigen::Dynamic>& exact)
    : middle(exact.rows(), exact.cols()), radius(exact.rows(), exact.cols()) {
  for (Eigen::Index i = 0; i < exact.rows(); ++i)
    for (Eigen::Index j = 0; j < exact.cols(); ++j) {
      const Interval value = exact(i, j).enclosure();
      middle(i, j) = value.middle();
      radius(i, j) = std::max((Interval(value.high) - Interval(middle(i, j))).high,
                              (Interval(middle(i, j)) - Interval(value.low)).high);
    }
}

BallMatrix operator*(const BallMatrix& a, const BallMatrix& b) {
  BallMatrix c;
  c.middle = a.middle * b.middle;
  const Eigen::MatrixXd size = a.middle.cwiseAbs(), other = b.middle.cwiseAbs();
  const double n = static_cast<double>(a.middle.cols());
  // (n + 2) eps of rounding in the middle; the factor covers that of this line itself.
  c.radius =
      (size * b.radius + a.radius * (other + b.radius) + (n + 2) * eps * (size * other)) * (1 + 4 * (n + 4) * eps);
  c.radius.array() += tiny;
  return c;
}

BallMatrix operator-(const BallMatrix& a, const BallMatrix& b) {
  BallMatrix c;
  c.middle = a.middle - b.middle;
  c.radius = (a.radius + b.radius + 2 * eps * c.middle.cwiseAbs()) * (1 + 8 * eps);
  return c;
}

BallMatrix scaled(const BallMatrix& a, double power_of_two) {
  BallMatrix c;
  c.middle = power_of_two * a.middle;
  c.radius = (power_of_two * a.radius).array() + tiny;
  return c;
}

BallMatrix transposed(const BallMatrix& a) {
  BallMatrix b;
  b.middle = a.middle.transpose();
  b.radius = a.radius.transpose();
  return b;
}

std::optional<BallMatrix> similar_matrix(const BallMatrix& A, const Eigen::MatrixXd& G) {
  const Eigen::Index n = G.rows();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n), near = G.inverse();
  if (!near.allFinite()) return std::nullopt;
  BallMatrix inverse(near);
  // G^-1 = (1 + E)^-1 Y with Y G = 1 + E, and (1 + E)^-1 - 1 has row sums below |E|/(1 - |E|).
  const double error = maximum_norm(inverse * BallMatrix(G) - BallMatrix(one)).high;
  if (!(error < 0.5)) return std::nullopt;
  for (Eigen::Index j = 0; j < n; ++j)
    inverse.radius.col(j).setConstant((Interval(2 * error) * Interval(near.col(j).cwiseAbs().maxCoeff())).high);
  return inverse * A * BallMatrix(G);
}

Interval maximum_norm(const BallMatrix& a) {
  Interval largest = 0;
  for (Eigen::Index i = 0; i < a.middle.rows(); ++i) {
    Interval sum = 0;
    for (Eigen::Index j = 0; j < a.middle.cols(); ++j) {
      const Interval radius(-a.radius(i, j), a.radius(i, j));
      sum += abs(Interval(a.middle(i, j)) + radius);
    }
    if (std::isnan(sum.low) || std::isnan(sum.high)) return {0, infinity};
    largest = max(largest, sum);
  }
  return largest;
}

Interval trace(const BallMatrix& a) {
  Interval sum = 0;
  for (Eigen::Index i = 0; i < a.middle.rows(); ++i)
    sum += Interval(a.middle(i, i)) + Interval(-a.radius(i, i), a.radius(i, i));
  return sum;
}

Interval spectral_radius(BallMatrix a) {
  if (a.rows() == 1) return abs(trace(a));
  Interval best(0, maximum_norm(a).high);
  double exponent = 0, steps = 1;  // the matrix to the power of `steps` is 2^exponent times a
  for (int k = 0; k <= 30; ++k) {
    const double norm = maximum_norm(a).high;
    if (!(norm > 0x1p-900 && norm < infinity)) break;
    const double shift = std::floor(std::log2(norm));
    a = scaled(a, std::exp2(-shift));
    exponent += shift;
    const auto rooted = [&](const Interval& x) {
      const Interval sum = Interval(exponent) + log2(x);
      return Interval(power_of_two(sum.low / steps, -1), power_of_two(sum.high / steps, 1));  // by a power of two
    };
    best.high = std::min(best.high, rooted(maximum_norm(a)).high);
    const double part = quotient(abs(trace(a)).low, static_cast<double>(a.rows())).low;
    if (part > 0) best.low = std::max(best.low, rooted(part).low);
    a = a * a;
    exponent *= 2;
    steps *= 2;
  }
  return best;
}

}  // namespace sublimit
