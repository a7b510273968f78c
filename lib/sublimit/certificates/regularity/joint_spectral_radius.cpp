// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/joint_spectral_radius.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sublimit/certificates/regularity/absolute_hull.h"
#include "sublimit/core/dense_decompositions.h"

namespace sublimit {
namespace {

using Matrices = std::vector<BallMatrix>;
constexpr double unbounded = std::numeric_limits<double>::infinity();

struct Product {
  std::vector<int> factors;
  Eigen::MatrixXd value;
};

double radius(const Eigen::MatrixXd& A) { return eigenvalues(A).cwiseAbs().maxCoeff(); }

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

/// Coordinates of row vectors, u G, in which all matrices are small together: Q = G G^T solves Q = 1 + sum A Q
/// A^T/rate^2, for a rate just large enough, and then u A is no longer than rate * u in the norm u Q u^T.
Eigen::MatrixXd balanced_coordinates(const Matrices& matrices) {
  const Eigen::Index n = matrices[0].rows();
  const auto image = [&](const Eigen::MatrixXd& Q) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
    for (const BallMatrix& A : matrices) sum += A.middle * Q * A.middle.transpose();
    return sum;
  };
  Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(n, n);
  double growth = 0;
  for (int k = 0; k < 200; ++k) {
    const Eigen::MatrixXd next = image(Q);
    growth = next.norm() / Q.norm();
    if (!(growth > 0)) return Eigen::MatrixXd::Identity(n, n);
    Q = next / next.norm();
  }
  Q.setIdentity();
  Eigen::MatrixXd term = Q;
  for (int k = 0; k < 200; ++k) {
    term = image(term) / (1.2 * growth);
    Q += term;
  }
  Q /= Q.diagonal().maxCoeff();
  const SymmetricEigenvectors axes = symmetric_eigenvectors(Q);
  return axes.vectors * axes.values.cwiseMax(1e-14).cwiseSqrt().asDiagonal();
}

/// A polytope that all matrices, divided by `rate`, map into itself, up to rounding; it contains
/// leading left eigenvectors and a small multiple of all unit vectors. Nothing if it gets too large.
std::optional<Eigen::MatrixXd> invariant_polytope(const Matrices& matrices,
                                                  const std::vector<Eigen::RowVectorXd>& leading, double rate,
                                                  const JointSpectralRadiusOptions& options) {
  const Eigen::Index n = matrices[0].rows();
  Eigen::MatrixXd points = 0.25 * Eigen::MatrixXd::Identity(n, n);
  const auto is_inside = [&](const Eigen::RowVectorXd& x) {
    return least_combination(points, x).lpNorm<1>() <= 1 + 1e-9;
  };
  const auto add = [&](const Eigen::RowVectorXd& x) {
    points.conservativeResize(points.rows() + 1, Eigen::NoChange);
    points.bottomRows(1) = x;
  };
  for (const Eigen::RowVectorXd& x : leading)
    if (!is_inside(x)) add(x);
  // Leading ones first: what they grow into makes the polytope, and most of what small vectors become is inside then.
  std::vector<Eigen::Index> waiting;
  for (Eigen::Index i = 0; i < points.rows(); ++i) waiting.push_back((i + n) % points.rows());
  for (size_t next = 0; next < waiting.size(); ++next) {
    const Eigen::RowVectorXd from = points.row(waiting[next]);
    for (const BallMatrix& A : matrices) {
      const Eigen::RowVectorXd x = from * A.middle / rate;
      if (is_inside(x)) continue;
      if (points.rows() >= options.most_vertices) return std::nullopt;
      waiting.push_back(points.rows());
      add(x);
    }
  }
  return points;
}

double above_root(double x) { return std::nextafter(std::sqrt(x), unbounded); }

}  // namespace

Matrices balanced(const Matrices& matrices) {
  if (matrices[0].rows() == 1) return matrices;
  const Eigen::MatrixXd G = balanced_coordinates(matrices);
  Matrices turned;
  for (const BallMatrix& A : matrices) {
    const std::optional<BallMatrix> similar = similar_matrix(A, G);
    if (!similar) return matrices;
    turned.push_back(*similar);
  }
  return turned;
}

double product_radius(const Matrices& matrices, const std::vector<int>& factors) {
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

double norm_bound(const Matrices& matrices, const Eigen::MatrixXd& polytope) {
  const Eigen::Index n = polytope.cols(), count = polytope.rows();
  const double unit = polytope(0, 0);
  int exponent = 0;
  if (polytope.topRows(n) != unit * Eigen::MatrixXd::Identity(n, n) || std::frexp(unit, &exponent) != 0.5)
    return unbounded;
  const BallMatrix exact(polytope);
  double bound = 0;
  for (const BallMatrix& A : matrices) {
    // polytope A = C polytope + R: |A x| <= (|C| + |R|/unit) |x|, since |x|_max <= |x|/unit.
    const Eigen::MatrixXd image = polytope * A.middle;
    Eigen::MatrixXd C(count, count);
    for (Eigen::Index i = 0; i < count; ++i) C.row(i) = least_combination(polytope, image.row(i));
    const BallMatrix rest = exact * A - BallMatrix(C) * exact;
    for (Eigen::Index i = 0; i < count; ++i) {
      Interval sum = 0, part = 0;
      for (Eigen::Index j = 0; j < count; ++j) sum += std::abs(C(i, j));
      for (Eigen::Index j = 0; j < n; ++j) part += Interval(std::abs(rest.middle(i, j))) + Interval(rest.radius(i, j));
      const double row = (sum + part * Interval(1 / unit)).high;
      if (std::isnan(row)) return unbounded;  // nothing compares with it: later rows would hide it
      bound = std::max(bound, row);
    }
  }
  return bound;
}

JointSpectralRadius joint_spectral_radius(const Matrices& given, const JointSpectralRadiusOptions& options) {
  JointSpectralRadius result;
  result.high = 0;
  for (const BallMatrix& A : given) result.high = std::max(result.high, maximum_norm(A).high);
  const Matrices matrices = balanced(given);
  // In balanced coordinates Euclidean norms are small: |A|^2 is the spectral radius of A^T A.
  double euclidean = 0;
  for (const BallMatrix& A : matrices) euclidean = std::max(euclidean, spectral_radius(transposed(A) * A).high);
  euclidean = above_root(euclidean);
  result.high = std::min(result.high, euclidean);
  const std::vector<Product> products = leading_products(matrices, options);
  result.product = products.front().factors;
  result.low = product_radius(matrices, result.product);
  if (matrices[0].rows() == 1 || result.high == 0) return result;
  double candidate = result.low;
  for (const Product& p : products) candidate = std::max(candidate, rooted(radius(p.value), p.factors.size()));
  if (candidate <= 0) return result;
  std::vector<Eigen::RowVectorXd> leading;
  for (const Product& p : products) {
    const Eigenvectors modes = eigenvectors(p.value.transpose());
    Eigen::Index at = 0;
    modes.values.cwiseAbs().maxCoeff(&at);
    const Eigen::VectorXcd v = modes.vectors.col(at) / modes.vectors.col(at).cwiseAbs().maxCoeff();
    for (const Eigen::RowVectorXd& part : {Eigen::RowVectorXd(v.real()), Eigen::RowVectorXd(v.imag())})
      if (part.norm() > 1e-9) leading.push_back(part);
  }
  for (const double slack : {1.0, 0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
    const double rate = candidate * (1 + slack);
    if (rate >= result.high) continue;
    if (slack < options.least_slack) break;
    const std::optional<Eigen::MatrixXd> polytope = invariant_polytope(matrices, leading, rate, options);
    if (!polytope) break;  // the closer the rate, the more vertices
    const double bound = norm_bound(matrices, *polytope);
    if (bound >= result.high) break;
    result.high = bound;
    result.vertices = static_cast<int>(polytope->rows());
  }
  return result;
}

}  // namespace sublimit
