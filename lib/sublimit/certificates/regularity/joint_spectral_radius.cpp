// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/joint_spectral_radius.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sublimit/certificates/regularity/absolute_hull.h"
#include "sublimit/core/detail/dense_decompositions.h"

namespace sublimit {
namespace {

using Matrices = std::vector<BallMatrix>;
using Doubles = std::vector<Eigen::MatrixXd>;
constexpr double on_the_polytope = 1 + 1e-9;  // up to rounding
constexpr double unbounded = std::numeric_limits<double>::infinity();

struct Product {
  std::vector<int> factors;
  Eigen::MatrixXd value;
};

double radius(const Eigen::MatrixXd& A) { return eigenvalues(A).cwiseAbs().maxCoeff(); }

Doubles middles(const Matrices& matrices) {
  Doubles result;
  for (const BallMatrix& A : matrices) result.push_back(A.middle());
  return result;
}

/// x^(1/2^k), k >= 0.
Ball repeated_root(Ball x, int k) {
  for (; k > 0; --k) x = sqrt(x);
  return x;
}

/// x^(1/n) by doubles.
double rooted(double x, size_t n) { return std::pow(x, 1 / static_cast<double>(n)); }

/// Products whose averaged spectral radius is largest, by doubles; the shortest of those that are alike.
std::vector<Product> leading_products(const Doubles& matrices, const JointSpectralRadiusOptions& options) {
  std::vector<Product> level, best;
  double most = -1;
  level.push_back({{}, Eigen::MatrixXd::Identity(matrices[0].rows(), matrices[0].rows())});
  size_t tried = 0;
  for (int length = 1; length <= options.longest; ++length) {
    if (tried + level.size() * matrices.size() > static_cast<size_t>(options.most_products)) break;
    std::vector<Product> longer;
    for (const Product& p : level)
      for (size_t i = 0; i < matrices.size(); ++i) {
        Product q{p.factors, matrices[i] * p.value};
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
Eigen::MatrixXd balanced_coordinates(const Doubles& matrices) {
  const Eigen::Index n = matrices[0].rows();
  const auto image = [&](const Eigen::MatrixXd& Q) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
    for (const Eigen::MatrixXd& A : matrices) sum += A * Q * A.transpose();
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
std::optional<Eigen::MatrixXd> invariant_polytope(const Doubles& matrices,
                                                  const std::vector<Eigen::RowVectorXd>& leading, double rate,
                                                  const JointSpectralRadiusOptions& options) {
  const Eigen::Index n = matrices[0].rows();
  Eigen::MatrixXd points = 0.25 * Eigen::MatrixXd::Identity(n, n);
  const auto is_inside = [&](const Eigen::RowVectorXd& x) {
    return least_combination(points, x, on_the_polytope).lpNorm<1>() <= on_the_polytope;
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
    for (const Eigen::MatrixXd& A : matrices) {
      const Eigen::RowVectorXd x = from * A / rate;
      if (is_inside(x)) continue;
      if (points.rows() >= options.most_vertices) return std::nullopt;
      waiting.push_back(points.rows());
      add(x);
    }
  }
  return points;
}

}  // namespace

Matrices balanced(const Matrices& matrices) {
  if (matrices[0].rows() == 1) return matrices;
  const BallMatrix G(balanced_coordinates(middles(matrices)));
  const std::optional<BallMatrix> inverse = G.inverse();
  if (!inverse) return matrices;
  Matrices turned;
  for (const BallMatrix& A : matrices) turned.push_back(*inverse * A * G);
  return turned;
}

double euclidean_norm(const BallMatrix& A) {
  BallMatrix rest = A.transposed() * A;
  const Eigen::MatrixXd near = rest.middle();
  if (!near.allFinite()) return unbounded;
  const Ball square(std::max(symmetric_eigenvectors(near).values.maxCoeff() * (1 + 0x1p-40), 0x1p-900));
  arb_mat_neg(rest.get(), rest.get());
  for (Eigen::Index i = 0; i < rest.rows(); ++i)
    arb_add(rest.entry(i, i), rest.entry(i, i), square.get(), PrecisionScope::bits());
  BallMatrix factor(rest.rows(), rest.rows());
  return arb_mat_cho(factor.get(), rest.get(), PrecisionScope::bits()) ? sqrt(square).upper() : unbounded;
}

double spectral_radius_below(BallMatrix A) {
  const Ball n(static_cast<long>(A.rows()));
  double best = 0;
  for (int k = 0; k <= 30 && arb_mat_is_finite(A.get()); ++k) {  // A is the given one to the power of 2^k
    const Ball part = abs(A.trace()) / n;
    if (!part.contains_zero()) best = std::max(best, repeated_root(part, k).lower());
    if (A.rows() == 1) break;
    arb_mat_sqr(A.get(), A.get(), PrecisionScope::bits());
  }
  return best;
}

double product_radius(const Matrices& matrices, const std::vector<int>& factors) {
  BallMatrix product = matrices[factors.back()];
  for (size_t i = factors.size() - 1; i-- > 0;) product = matrices[factors[i]] * product;
  const Ball low(spectral_radius_below(std::move(product)));
  Ball root, power;
  arb_root_ui(root.get(), low.get(), factors.size(), PrecisionScope::bits());
  arb_pow_ui(power.get(), Ball(root.mid()).get(), factors.size(), PrecisionScope::bits());
  return arb_le(power.get(), low.get()) ? root.mid() : root.lower();  // powers of two have their roots
}

double norm_bound(const Matrices& matrices, const Eigen::MatrixXd& polytope, std::optional<double> level) {
  const Eigen::Index n = polytope.cols(), count = polytope.rows();
  const double unit = polytope(0, 0);
  if (!(unit > 0) || polytope.topRows(n) != unit * Eigen::MatrixXd::Identity(n, n)) return unbounded;
  const BallMatrix exact(polytope);
  double bound = 0;
  for (const BallMatrix& A : matrices) {
    // polytope A = C polytope + R: |A x| <= (|C| + |R|/unit) |x|, since |x|_max <= |x|/unit. C may be any doubles.
    const Eigen::MatrixXd image = polytope * A.middle();
    BallMatrix rest = exact * A;
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::RowVectorXd C = least_combination(polytope, image.row(i), level);
      Ball row;
      for (Eigen::Index j = 0; j < count; ++j) {
        if (C[j] == 0) continue;  // most of them
        const Ball weight(C[j]);
        row += abs(weight);
        for (Eigen::Index k = 0; k < n; ++k)
          arb_submul(rest.entry(i, k), weight.get(), exact.entry(j, k), PrecisionScope::bits());
      }
      for (Eigen::Index k = 0; k < n; ++k) row += abs(rest(i, k)) / Ball(unit);
      if (!row.is_finite()) return unbounded;  // nothing compares with it: later rows would hide it
      bound = std::max(bound, row.upper());
    }
  }
  return bound;
}

JointSpectralRadius joint_spectral_radius(const Matrices& given, const JointSpectralRadiusOptions& options) {
  JointSpectralRadius result;
  result.high = 0;
  for (const BallMatrix& A : given) result.high = std::max(result.high, maximum_norm(A).upper());
  const Matrices matrices = balanced(given);
  const Doubles near = middles(matrices);
  // In balanced coordinates Euclidean norms are small.
  double euclidean = 0;
  for (const BallMatrix& A : matrices) euclidean = std::max(euclidean, euclidean_norm(A));
  result.high = std::min(result.high, euclidean);
  const std::vector<Product> products = leading_products(near, options);
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
    const std::optional<Eigen::MatrixXd> polytope = invariant_polytope(near, leading, rate, options);
    if (!polytope) break;  // the closer the rate, the more vertices
    const double bound = norm_bound(matrices, *polytope, rate * on_the_polytope);
    if (bound >= result.high) break;
    result.high = bound;
    result.vertices = static_cast<int>(polytope->rows());
  }
  return result;
}

}  // namespace sublimit
