// SPDX-License-Identifier: Apache-2.0
#include "sublimit/analysis/regularity/joint_spectral_radius.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <optional>

#include "sublimit/analysis/regularity/absolute_hull.h"

namespace sublimit {
namespace {

using Matrices = std::vector<BallMatrix>;

struct Product {
  std::vector<int> factors;
  Eigen::MatrixXd value;
};

double radius(const Eigen::MatrixXd& A) { return A.eigenvalues().cwiseAbs().maxCoeff(); }

/// x^(1/n) by doubles.
double rooted(double x, size_t n) { return std::pow(x, 1 / static_cast<double>(n)); }

/// Products whose averaged spectral radius is largest, by doubles; the shortest of those that are alike.
std::vector<Product> leading_products(const Matrices& matrices, const JointSpectralRadiusOptions& options) {
  std::vector<Product> level, best;
  double most = -1;
  level.push_back({{}, Eigen::MatrixXd::Identity(matrices[0].rows(), matrices[0].rows())});
  size_t tried = 0;
  for (int length = 1; length <= options.longest; ++length) {
    if (tried + level.size() * matrices.size() > static_cast<size_t>(options.most_products)) break;
    std::vector<Product> longer;
    for (const Product& p : level)
      for (size_t i = 0; i < matrices.size(); ++i) {
        Product q{p.factors, matrices[i].middle * p.value};
        q.factors.insert(q.factors.begin(), static_cast<int>(i));
        const double r = rooted(radius(q.value), q.factors.size());
        ++tried;
        if (r > most * (1 + 1e-9)) {
          most = r;
          best.clear();
        }
        // Others of the same length that do as well, but no rotations of the same product.
        if (r >= most * (1 - 1e-9) && (best.empty() || best[0].factors.size() == q.factors.size())) {
          bool is_rotation = false;
          for (const Product& b : best)
            for (size_t k = 0; k < b.factors.size() && !is_rotation; ++k) {
              std::vector<int> turned(b.factors.begin() + k, b.factors.end());
              turned.insert(turned.end(), b.factors.begin(), b.factors.begin() + k);
              is_rotation = turned == q.factors;
            }
          if (!is_rotation) best.push_back(q);
        }
        longer.push_back(std::move(q));
      }
    level = std::move(longer);
  }
  return best;
}

/// A polytope around the rows of leading left eigenvectors that all matrices, divided by `rate`, map into itself;
/// nothing if it gets too large.
std::optional<Eigen::MatrixXd> invariant_polytope(const Matrices& matrices, const std::vector<Product>& leading,
                                                  double rate, const JointSpectralRadiusOptions& options) {
  const Eigen::Index n = matrices[0].rows();
  Eigen::MatrixXd points = 0x1p-6 * Eigen::MatrixXd::Identity(n, n);
  std::vector<Eigen::RowVectorXd> waiting;
  for (Eigen::Index i = 0; i < n; ++i) waiting.push_back(points.row(i));
  const auto is_inside = [&](const Eigen::RowVectorXd& x) {
    return least_combination(points, x).lpNorm<1>() <= 1 + 1e-9;
  };
  const auto add = [&](const Eigen::RowVectorXd& x) {
    points.conservativeResize(points.rows() + 1, Eigen::NoChange);
    points.bottomRows(1) = x;
    waiting.push_back(x);
  };
  for (const Product& p : leading) {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(p.value.transpose());
    Eigen::Index at = 0;
    solver.eigenvalues().cwiseAbs().maxCoeff(&at);
    const Eigen::VectorXcd v = solver.eigenvectors().col(at) / solver.eigenvectors().col(at).cwiseAbs().maxCoeff();
    for (const Eigen::RowVectorXd& part : {Eigen::RowVectorXd(v.real()), Eigen::RowVectorXd(v.imag())})
      if (part.norm() > 1e-9 && !is_inside(part)) add(part);
  }
  for (size_t next = 0; next < waiting.size(); ++next)
    for (const BallMatrix& A : matrices) {
      const Eigen::RowVectorXd x = waiting[next] * A.middle / rate;
      if (is_inside(x)) continue;
      if (points.rows() >= options.most_vertices) return std::nullopt;
      add(x);
    }
  return points;
}

/// Of a product of enclosures.
double certain_radius(const Matrices& matrices, const std::vector<int>& factors) {
  BallMatrix product = matrices[factors.back()];
  for (size_t i = factors.size() - 1; i-- > 0;) product = matrices[factors[i]] * product;
  const double low = spectral_radius(product).low;
  if (low <= 0 || factors.size() == 1) return low;
  double root = rooted(low, factors.size());
  while (root > 0) {  // down until its power is certainly below
    Interval power = 1;
    for (size_t i = 0; i < factors.size(); ++i) power *= root;
    if (power.high <= low) return root;
    root = std::nextafter(root, 0);
  }
  return 0;
}

}  // namespace

double norm_bound(const Matrices& matrices, const Eigen::MatrixXd& polytope) {
  const Eigen::Index n = polytope.cols(), count = polytope.rows();
  const double unit = polytope(0, 0);
  int exponent = 0;
  if (polytope.topRows(n) != unit * Eigen::MatrixXd::Identity(n, n) || std::frexp(unit, &exponent) != 0.5)
    return INFINITY;
  double bound = 0;
  for (const BallMatrix& A : matrices) {
    // polytope A = C polytope + R: |A x| <= (|C| + |R|/unit) |x|, since |x|_max <= |x|/unit.
    const Eigen::MatrixXd image = polytope * A.middle;
    Eigen::MatrixXd C(count, count);
    for (Eigen::Index i = 0; i < count; ++i) C.row(i) = least_combination(polytope, image.row(i));
    const BallMatrix exact(polytope);
    const BallMatrix rest = exact * A - BallMatrix(C) * exact;
    for (Eigen::Index i = 0; i < count; ++i) {
      Interval sum = 0, part = 0;
      for (Eigen::Index j = 0; j < count; ++j) sum += std::abs(C(i, j));
      for (Eigen::Index j = 0; j < n; ++j) part += Interval(std::abs(rest.middle(i, j))) + Interval(rest.radius(i, j));
      bound = std::max(bound, (sum + part * Interval(1 / unit)).high);
    }
  }
  return bound;
}

JointSpectralRadius joint_spectral_radius(const Matrices& matrices, const JointSpectralRadiusOptions& options) {
  JointSpectralRadius result;
  result.high = 0;
  for (const BallMatrix& A : matrices) result.high = std::max(result.high, maximum_norm(A).high);
  const std::vector<Product> leading = leading_products(matrices, options);
  result.product = leading.front().factors;
  result.low = certain_radius(matrices, result.product);
  if (matrices[0].rows() == 1 || result.high == 0) return result;
  double candidate = result.low;
  for (const Product& p : leading) candidate = std::max(candidate, rooted(radius(p.value), p.factors.size()));
  if (candidate <= 0) return result;
  for (double slack = options.slack; slack < 3; slack *= 10) {
    const double rate = candidate * (1 + slack);
    if (rate >= result.high) break;
    const std::optional<Eigen::MatrixXd> polytope = invariant_polytope(matrices, leading, rate, options);
    if (!polytope) continue;
    const double bound = norm_bound(matrices, *polytope);
    if (bound < result.high) {
      result.high = bound;
      result.polytope = *polytope;
      break;
    }
  }
  return result;
}

}  // namespace sublimit
