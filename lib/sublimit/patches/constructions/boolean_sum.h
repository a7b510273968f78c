// SPDX-License-Identifier: Apache-2.0
#pragma once
// Boolean sums of curves as control nets. With functionals k along u (values or derivatives at given
// parameters), their dual functions phi_k(u), and likewise l and psi_l(v) along v,
//
//   S = sum_l psi_l(v) C_l(u) + sum_k phi_k(u) D_k(v) - sum_kl phi_k(u) psi_l(v) Q_kl,   Q_kl = functional k of C_l
//
// interpolates all curves C_l(u) and D_k(v), provided that functional l of D_k is Q_kl too. If all of these are
// splines over common knots in u and in v, so is S, and its control points are the same sum of coefficients.
// Source: Coons 1967; Gordon 1969, "Spline-blended surface interpolation through curve networks".
#include <Eigen/Core>

#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// The terms of a boolean sum.
/// @tparam Row  row of a point, or of weights over data
template <class Row>
struct BooleanSum {
  Eigen::MatrixXd phi, psi;            ///< coefficients: #points in u x #functionals, the same in v
  std::vector<std::vector<Row>> C, D;  ///< C[l][i], D[k][j]: control points of curves
  std::vector<std::vector<Row>> Q;     ///< Q[k][l]

  /// Returns control point (i, j).
  Row at(Index i, Index j) const {
    Row sum = D[0][size_t(j)] * phi(i, 0);
    for (size_t k = 1; k < D.size(); ++k)
      if (const double weight = phi(i, Eigen::Index(k)); weight != 0) sum += D[k][size_t(j)] * weight;
    for (size_t l = 0; l < C.size(); ++l)
      if (const double weight = psi(j, Eigen::Index(l)); weight != 0) sum += C[l][size_t(i)] * weight;
    for (size_t k = 0; k < D.size(); ++k)
      for (size_t l = 0; l < C.size(); ++l)
        if (const double weight = phi(i, Eigen::Index(k)) * psi(j, Eigen::Index(l)); weight != 0)
          sum -= Q[k][l] * weight;
    return sum;
  }
};

}  // namespace sublimit
