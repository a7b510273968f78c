// SPDX-License-Identifier: Apache-2.0
#include "sublimit/curves/detail/curve_polynomial.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sublimit {
namespace {

using Real = CurvePolynomial::Real;
using Row = CurvePolynomial::Row;
using MatrixL = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double double_epsilon = std::numeric_limits<double>::epsilon();
constexpr int most_degree = 20;  // above, Bernstein coefficients would lose the digits that long double adds

/// Weights of the Bernstein polynomials of a degree, by their recurrence: sums of positive terms.
template <class Real>
void bernstein(int degree, Real y, Real* weights) {
  weights[0] = 1;
  for (int d = 1; d <= degree; ++d) {
    weights[d] = y * weights[d - 1];
    for (int i = d - 1; i > 0; --i) weights[i] = (1 - y) * weights[i] + y * weights[i - 1];
    weights[0] *= 1 - y;
  }
}

/// Coefficients without what rounding leaves of zeros, relative to the size of weights.
MatrixL without_rounding(const MatrixL& C, Real size) {
  return C.unaryExpr([size](Real x) { return std::abs(x) < size * Real(double_epsilon) / 16 ? Real(0) : x; });
}

}  // namespace

std::optional<CurvePolynomial> polynomial_through(const std::vector<CurvePolynomial::Row>& values, int highest) {
  const int last = static_cast<int>(values.size()) - 1;
  const Index width = static_cast<Index>(values[0].size());
  MatrixL best;
  Real least = 16 * Real(double_epsilon);
  highest = std::min(highest, most_degree);
  // The leading terms of high degrees are small, so the first that fits need not be the one: it goes on as long as one
  // of the next two (polynomials may be odd) fits better by far.
  for (int degree = 0; degree <= highest && (best.rows() == 0 || degree <= best.rows() + 1); ++degree) {
    // Nodes near to Chebyshev's.
    std::vector<int> nodes;
    for (int i = 0; i <= degree; ++i) {
      const double share = degree == 0 ? 0 : (1 - std::cos(std::numbers::pi * i / degree)) / 2;
      nodes.push_back(static_cast<int>(std::lround(last * share)));
    }
    if (std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end()) break;
    MatrixL collocation(degree + 1, degree + 1), right(degree + 1, width);
    std::vector<Real> weights(degree + 1);
    const auto at = [&](int i) {
      bernstein(degree, Real(i) / last, weights.data());
      return Eigen::Map<const Row>(weights.data(), degree + 1);
    };
    for (int i = 0; i <= degree; ++i) {
      collocation.row(i) = at(nodes[i]);
      right.row(i) = values[nodes[i]];
    }
    MatrixL C = collocation.partialPivLu().solve(right);
    C.row(0) = values.front();
    C.row(degree) = values.back();
    Real error = 0;
    for (int i = 0; i <= last && error <= least; ++i)
      error = std::max(error, (at(i) * C - values[i]).cwiseAbs().maxCoeff());
    if (error > least) continue;
    best = without_rounding(C, 1);
    least = error / 8;
  }
  if (best.rows() == 0) return std::nullopt;
  CurvePolynomial p;
  p.degree = static_cast<int>(best.rows()) - 1;
  p.coefficients[0] = best.cast<double>();
  for (int k = 1; k <= 2; ++k) {
    if (p.degree < k) {
      p.coefficients[k] = CurvePolynomial::Matrix::Zero(1, width);
      continue;
    }
    const Eigen::Index rows = best.rows() - 1;
    best = without_rounding(Real(rows) * (best.bottomRows(rows) - best.topRows(rows)), Real(rows));
    p.coefficients[k] = best.cast<double>();
  }
  return p;
}

void CurvePolynomial::evaluate(double y, int derivatives, Index width, double* weights) const {
  double basis[most_degree + 1];
  for (int k = 0; k <= derivatives; ++k) {
    const int lowered = std::max(0, degree - k);
    bernstein(lowered, y, basis);
    double* row = weights + k * width;
    std::fill(row, row + width, 0.0);
    for (int i = 0; i <= lowered; ++i) {
      const double* row_of_i = coefficients[k].data() + i * width;
      for (Index j = 0; j < width; ++j) row[j] += basis[i] * row_of_i[j];
    }
  }
}

}  // namespace sublimit
