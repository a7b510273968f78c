// SPDX-License-Identifier: Apache-2.0
#pragma once
// Joint spectral radius of a set of matrices: the growth per factor of their longest products. From below, spectral
// radii of finite products; from above, a norm in which all of the matrices are small: that of a polytope which they
// map into itself, up to a factor. Both are found with doubles and then verified with enclosures. Source: Rota, Strang
// 1960; Guglielmi, Protasov 2013, "Exact computation of joint spectral characteristics of linear operators", Found.
// Comput. Math. 13 (the polytope).
#include <vector>

#include "sublimit/analysis/regularity/ball_matrix.h"

namespace sublimit {

struct JointSpectralRadius {
  double low = 0, high = 0;       ///< certain
  std::vector<int> product = {};  ///< the indices of factors whose product gives `low`, last factor first
  Eigen::MatrixXd polytope = {};  ///< rows: functionals; the norm max |row x| gives `high`; empty: plain norms did
};

struct JointSpectralRadiusOptions {
  int longest = 8;  ///< products tried from below
  int most_products = 40000;
  int most_vertices = 400;  ///< of the polytope
  double slack = 1e-7;      ///< relative, of the first polytope tried; more where it grows too large
};

/// @param matrices  square, of one size, at least one
JointSpectralRadius joint_spectral_radius(const std::vector<BallMatrix>& matrices,
                                          const JointSpectralRadiusOptions& options = {});

/// Certain bound from above that a norm max |row x| gives: of a polytope whose first rows are a power of two times
/// the identity.
double norm_bound(const std::vector<BallMatrix>& matrices, const Eigen::MatrixXd& polytope);

}  // namespace sublimit
