// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/absolute_hull.h"

#include <vector>

namespace sublimit {

Eigen::RowVectorXd least_combination(const Eigen::MatrixXd& points, const Eigen::RowVectorXd& x) {
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
    if (values.cwiseAbs().maxCoeff(&entering) <= 1 + 1e-11) break;
    const double side = values[entering] < 0 ? -1 : 1;
    const Eigen::RowVectorXd direction = side * points.row(entering) * inverse;
    Eigen::Index leaving = -1;
    double least = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (direction[i] <= 1e-12) continue;
      const double ratio = weights[i] / direction[i];
      if (leaving < 0 || ratio < least) leaving = i, least = ratio;
    }
    if (leaving < 0) break;  // rounding
    const Eigen::VectorXd column = inverse.col(leaving) / direction[leaving];
    inverse -= column * direction;
    inverse.col(leaving) = column;
    basis[leaving] = entering;
    sign[leaving] = side;
    weights = (x * inverse).cwiseMax(0);
  }
  Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(points.rows());
  weights = x * inverse;
  for (Eigen::Index i = 0; i < n; ++i) result[basis[i]] += sign[i] * weights[i];
  return result;
}

}  // namespace sublimit
