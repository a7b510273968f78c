// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/absolute_hull.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sublimit {

Eigen::RowVectorXd least_combination(const Eigen::MatrixXd& points, const Eigen::RowVectorXd& x,
                                     std::optional<double> level) {
  const Eigen::Index n = points.cols();
  // Basis: rows of `points` with signs, so that x is a combination with weights >= 0. First the multiples of unit
  // vectors.
  std::vector<Eigen::Index> basis(n);
  Eigen::RowVectorXd sign(n), weights(n);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(n, n);  // x * inverse: weights of the basis
  for (Eigen::Index i = 0; i < n; ++i) {
    basis[i] = i;
    sign[i] = x[i] < 0 ? -1 : 1;
    weights[i] = std::abs(x[i]) / points(i, i);
    inverse(i, i) = sign[i] / points(i, i);
  }
  const Eigen::Index limit = 50 * n + 100;
  for (Eigen::Index round = 0; round < limit; ++round) {
    const Eigen::VectorXd prices = inverse * Eigen::VectorXd::Ones(n);
    const Eigen::VectorXd values = points * prices;
    Eigen::Index entering = 0;
    const double most = values.cwiseAbs().maxCoeff(&entering), sum = weights.sum();
    if (most <= 1 + 1e-11) break;
    // prices/most are a dual point: no combination has a sum below sum/most.
    if (level && (sum <= *level || sum > *level * most)) break;
    const double side = values[entering] < 0 ? -1 : 1;
    const Eigen::RowVectorXd direction = side * points.row(entering) * inverse;
    // Of those whose weights reach zero (nearly) first, the one that the basis changes most by: else it degenerates.
    Eigen::Index leaving = -1;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < n; ++i)
      if (direction[i] > 1e-10) least = std::min(least, (weights[i] + 1e-12) / direction[i]);
    for (Eigen::Index i = 0; i < n; ++i)
      if (direction[i] > 1e-10 && weights[i] <= least * direction[i] &&
          (leaving < 0 || direction[i] > direction[leaving]))
        leaving = i;
    if (leaving < 0) break;  // rounding
    const Eigen::VectorXd column = inverse.col(leaving) / direction[leaving];
    inverse -= column * direction;
    inverse.col(leaving) = column;
    basis[leaving] = entering;
    sign[leaving] = side;
    weights = (x * inverse).cwiseMax(0);
  }
  // The inverse has the rounding of all exchanges: the last basis is solved anew.
  Eigen::MatrixXd last(n, n);
  for (Eigen::Index i = 0; i < n; ++i) last.col(i) = sign[i] * points.row(basis[i]).transpose();
  const Eigen::VectorXd solved = last.partialPivLu().solve(x.transpose());
  Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(points.rows());
  for (Eigen::Index i = 0; i < n; ++i) result[basis[i]] += sign[i] * solved[i];
  return result;
}

}  // namespace sublimit
