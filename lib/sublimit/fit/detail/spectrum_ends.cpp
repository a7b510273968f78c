// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/spectrum_ends.h"

#include <algorithm>
#include <cmath>

#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/fit/detail/sparse_factors.h"

namespace sublimit {
namespace {

using Eigen::MatrixXd;

/// The same numbers on every machine, in (-1/2, 1/2).
MatrixXd random_columns(Index rows, Index columns) {
  std::uint64_t state = 1;
  MatrixXd result(rows, columns);
  for (double& x : result.reshaped()) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    x = double(state >> 40) / double(1 << 24) - 0.5;
  }
  return result;
}

MatrixXd times(const SparseMatrix& S, const MatrixXd& X) { return apply(S, Points(X)); }

/// X, orthonormal and orthogonal to the first columns of V.
MatrixXd orthonormal_to(const Eigen::Ref<const MatrixXd>& V, MatrixXd X) {
  for (int i = 0; i < 2; ++i) {  // once more, for what cancellation left
    X = orthonormal_columns(X);
    X -= V * (V.transpose() * X);
  }
  return orthonormal_columns(X);
}

}  // namespace

double largest_singular_value(const SparseMatrix& B, const SparseMatrix& Bt) {
  constexpr Index block = 2, steps = 24;
  const Index n = Index(B.cols()), most = std::min(n, block * steps);
  MatrixXd start = random_columns(n, std::min(n, block));
  start.col(0).setOnes();  // weights of points sum to one
  MatrixXd V(n, most);
  MatrixXd last = orthonormal_columns(start);
  Index found = 0;
  while (true) {
    V.middleCols(found, last.cols()) = last;
    found += Index(last.cols());
    if (found + last.cols() > most) break;
    last = orthonormal_to(V.leftCols(found), times(Bt, times(B, last)));
  }
  const MatrixXd BV = times(B, V.leftCols(found));
  return std::sqrt(std::max(0.0, symmetric_eigenvalues(BV.transpose() * BV)[found - 1]));
}

LeastSingular least_singular(const SparseMatrix& B, const SparseMatrix& Bt, double tiny, Index most) {
  const Index n = Index(B.cols());
  SparseMatrix G = product(Bt, B);
  double trace = 0;
  for (Index i = 0; i < n; ++i) trace = std::max(trace, G.coeff(i, i));
  if (trace == 0) {
    const Index count = std::min(n, most + 1);
    return {Eigen::VectorXd::Zero(count), Points::Identity(n, count)};
  }
  SparseMatrix shift(n, n);
  shift.setIdentity();
  const SparseFactors factors(SparseMatrix(G + shift * (1e-12 * trace)));
  LeastSingular result;
  // A solution with the factors of a large matrix takes a tenth of a second, so there the first space has to do.
  const bool large = n > 20000;
  const Index all_steps = large ? 36 : 48;
  for (Index block = std::min<Index>(n, large ? 3 : 6);; block = std::min({n, 3 * block, most + 1})) {
    const Index steps = std::max<Index>(2, all_steps / block);
    MatrixXd start = random_columns(n, block);
    double before = INFINITY;
    for (int round = 0; round < (large ? 1 : 6); ++round) {
      MatrixXd V(n, std::min(n, block * steps)), last = orthonormal_columns(start);
      Index found = 0;
      while (true) {
        V.middleCols(found, last.cols()) = last;
        found += Index(last.cols());
        if (found + last.cols() > V.cols()) break;
        last = orthonormal_to(V.leftCols(found), factors.solve(Points(last)));
      }
      const SingularValues s = singular_values(triangular_factor(times(B, V.leftCols(found))));
      result.values = s.values.reverse().head(block);
      start = V.leftCols(found) * s.right.rowwise().reverse().leftCols(block);
      const double now = result.values[block - 1];
      const Index vanishing = Index((result.values.array() <= tiny).count());
      const double least = vanishing < block ? result.values[vanishing] : now;
      if (round > 0 && (vanishing == block || std::abs(least - before) <= 1e-9 * least)) break;
      before = least;
    }
    result.vectors = start;
    if (result.values[block - 1] > tiny || block == n || block == most + 1) return result;
  }
}

}  // namespace sublimit
