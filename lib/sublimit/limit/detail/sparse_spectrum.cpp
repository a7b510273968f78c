// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/detail/sparse_spectrum.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <random>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/complex_decompositions.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/core/detail/sparse_lu.h"

namespace sublimit {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Sparse factors of A - shift. A shift that is an eigenvalue is moved by some units of rounding.
class Shifted {
 public:
  Shifted(const SparseMatrix& A, double shift) {
    for (double away = 4 * eps; away < 1e-8; away *= 16) {
      ColumnMatrix M = A;
      for (Index i = 0; i < static_cast<Index>(M.rows()); ++i) M.coeffRef(i, i) -= shift + away;
      M.makeCompressed();
      lu_.emplace(M);
      if (lu_->has_factors()) return;
    }
    throw AnalysisError("a local matrix cannot be factored");
  }
  template <class Right>
  MatrixXd solve(const Right& right) const {
    return lu_->solve(MatrixXd(right));
  }

 private:
  std::optional<SparseLu> lu_;
};

/// Columns without symmetry, the same at every run.
MatrixXd scattered(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  MatrixXd X(rows, columns);
  for (Eigen::Index i = 0; i < X.size(); ++i) X.data()[i] = number(random);
  return X;
}

struct RitzPairs {
  VectorXcd values;
  MatrixXcd vectors;
};
/// Eigenvalues and eigenvectors of an operator, seen from the space of its powers on a few vectors.
template <class Operator>
RitzPairs ritz_pairs(const Operator& take, Eigen::Index rows, int width, int powers) {
  MatrixXd V(rows, 0), images(rows, 0);
  MatrixXd next = orthonormal_columns(scattered(rows, width));
  for (int k = 0; k < powers; ++k) {
    const Eigen::Index known = V.cols();
    V.conservativeResize(rows, known + next.cols());
    V.rightCols(next.cols()) = next;
    const MatrixXd image = take(next);
    images.conservativeResize(rows, V.cols());
    images.rightCols(next.cols()) = image;
    next = image;
    for (int again = 0; again < 2; ++again) {
      next -= V * (V.transpose() * next).eval();
      next = orthonormal_columns(next);
    }
  }
  const Eigenvectors seen = eigenvectors(V.transpose() * images);
  return {seen.values, V * seen.vectors};
}

/// An eigenvector near an eigenvalue that is known to rounding.
VectorXd inverse_iterated(const Shifted& factors, VectorXd x) {
  for (int k = 0; k < 3; ++k) x = factors.solve(x.normalized());
  return x.normalized();
}

/// The leading real eigenvalues, positive and simple or not; nothing where others lead.
std::optional<EigenStructure> leading_by_inversion(const SparseMatrix& A, int count) {
  const Eigen::Index size = A.rows();
  const SparseMatrix transposed = A.transpose();
  const RitzPairs outer = ritz_pairs([&](const MatrixXd& X) { return MatrixXd(A * X); }, size, 2, 30);
  double largest = 0;
  for (const Complex value : outer.values) largest = std::max(largest, std::abs(value));
  // Each round puts the shift closer to the largest eigenvalue, as the others are now told apart.
  constexpr int rounds = 5, wide = 3, powers = 14;
  double shift = largest * 1.05 + eps;
  std::vector<std::pair<double, VectorXd>> pairs;
  for (int round = 0; round < rounds; ++round) {
    const Shifted factors(A, shift);
    const RitzPairs inner = ritz_pairs([&](const MatrixXd& X) { return factors.solve(X); }, size, wide, powers);
    std::vector<Eigen::Index> order(static_cast<size_t>(inner.values.size()));
    for (size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Eigen::Index>(i);
    std::sort(order.begin(), order.end(),
              [&](Eigen::Index a, Eigen::Index b) { return std::abs(inner.values[a]) > std::abs(inner.values[b]); });
    pairs.clear();
    const auto wanted = static_cast<size_t>(count) + 3;
    for (size_t i = 0; i < order.size() && pairs.size() < wanted; ++i) {
      const Complex value = shift + 1.0 / inner.values[order[i]];
      if (std::abs(value.imag()) > 1e-9 * largest) return std::nullopt;
      pairs.emplace_back(value.real(), inner.vectors.col(order[i]).real().normalized());
    }
    std::sort(pairs.begin(), pairs.end(), [](const auto& x, const auto& y) { return x.first > y.first; });
    double worst = 0;  // of those that are asked for; the others only keep the space wide
    for (size_t i = 0; i < std::min(pairs.size(), static_cast<size_t>(count) + 1); ++i)
      worst = std::max(worst, (A * pairs[i].second - pairs[i].first * pairs[i].second).norm());
    if (worst <= 1e-12 * largest) break;
    shift = pairs.front().first + std::max(0.2 * (pairs.front().first - pairs.back().first), 1e-7 * largest);
  }
  // What turns or changes sign does not come so close to a shift; seen from outside it would stand out, and converge.
  const double last = pairs[std::min(pairs.size(), static_cast<size_t>(count)) - 1].first;
  for (Eigen::Index i = 0; i < outer.values.size(); ++i) {
    const Complex value = outer.values[i];
    const bool is_among = std::abs(value.imag()) <= 1e-3 * largest && value.real() > 0;
    if (is_among || std::abs(value) <= last * (1 + 1e-3)) continue;
    const VectorXcd vector = outer.vectors.col(i).normalized();
    const VectorXd real = A * vector.real(), imaginary = A * vector.imag();
    const double away =
        std::hypot((real - (value * vector).real()).norm(), (imaginary - (value * vector).imag()).norm());
    if (away <= 1e-2 * largest) return std::nullopt;
  }
  if (!(last > 0)) return std::nullopt;

  EigenStructure result;
  const MatrixXd start = scattered(size, 1);
  double error_of_last = 0;
  for (const auto& [estimate, vector] : pairs) {
    double value = estimate;
    VectorXd left = start.col(0), right = vector;
    for (int k = 0; k < 2; ++k) {
      left = inverse_iterated(Shifted(transposed, value), k == 0 ? VectorXd(transposed * vector + 1e-3 * start) : left);
      right = inverse_iterated(Shifted(A, value), right);
      const double taken = left.dot(right);
      if (std::abs(taken) > 1e-6) value = left.dot(A * right) / taken;
    }
    const double conditioning = 1 / std::max(std::abs(left.dot(right)), eps);
    const double error = 1e3 * eps * largest * conditioning;
    if (!result.clusters.empty()) {
      EigenCluster& before = result.clusters.back();
      if (std::abs(before.value - value) <= error + error_of_last) {
        ++before.multiplicity;
        // As many eigenvectors as span a plane: of a Jordan block the second is the first again.
        const VectorXcd r = right.cast<Complex>(), l = left.cast<Complex>();
        const auto is_new = [](const MatrixXcd& have, const VectorXcd& v) {
          return (v - have * least_squares_solution(have, v)).norm() > 1e-6;
        };
        if (is_new(before.right, r) && is_new(before.left, l)) {
          before.right.conservativeResize(size, before.right.cols() + 1);
          before.right.rightCols(1) = r;
          before.left.conservativeResize(size, before.left.cols() + 1);
          before.left.rightCols(1) = l;
        }
        continue;
      }
      if (static_cast<int>(result.clusters.size()) == count) break;
    }
    EigenCluster cluster;
    cluster.value = value;
    cluster.left = left.cast<Complex>();
    cluster.right = right.cast<Complex>();
    cluster.conditioning = conditioning;
    error_of_last = error;
    result.clusters.push_back(std::move(cluster));
  }
  return result;
}

}  // namespace

EigenStructure leading_clusters(const SparseMatrix& A, int count) {
  if (A.rows() > most_dense_rows)
    if (std::optional<EigenStructure> leading = leading_by_inversion(A, count)) return *leading;
  return eigen_structure(MatrixXd(A).cast<Complex>(), 0, count);
}

VectorXd limit_weights(const SparseMatrix& A) {
  if (A.rows() <= most_dense_rows) return limit_weights(MatrixXd(A));
  const SparseMatrix transposed = A.transpose();
  const EigenStructure leading = leading_clusters(A, 2);
  const EigenCluster& one = leading.clusters[0];
  const bool dominant = leading.clusters.size() < 2 || std::abs(leading.clusters[1].value) < 1 - 1e-9;
  if (std::abs(one.value - 1.0) > 1e-9 || one.multiplicity > 1 || !dominant)
    throw AnalysisError("a local matrix has no limit: eigenvalue 1 is not simple and dominant");
  VectorXd l = inverse_iterated(Shifted(transposed, 1), one.left.col(0).real());
  l /= l.sum();
  if (!((transposed * l - l).norm() <= 1e-10))
    throw AnalysisError("a local matrix has no limit: eigenvalue 1 is not simple");
  return l;
}

VectorXd shifted_solution(const SparseMatrix& A, double mu, const VectorXd& right) {
  if (A.rows() <= most_dense_rows)
    return least_norm_solution(MatrixXd(A) - mu * MatrixXd::Identity(A.rows(), A.cols()), right, 1e-10);
  const Shifted factors(A, mu);
  const VectorXd start = scattered(A.rows(), 1).col(0).normalized();
  const bool singular = factors.solve(start).norm() > 1e10;
  if (!singular) return factors.solve(right);
  const VectorXd r = inverse_iterated(factors, start);
  const VectorXd l = inverse_iterated(Shifted(A.transpose(), mu), start);
  VectorXd x = factors.solve(right - l * l.dot(right));
  x -= r * r.dot(x);
  return x;
}

}  // namespace sublimit
