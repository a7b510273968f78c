// SPDX-License-Identifier: Apache-2.0
#pragma once
// Joint spectral radius of a set of matrices: the growth per factor of their longest products. From below, spectral
// radii of finite products; from above, a norm in which all of the matrices are small: that of a polytope which they
// map into itself, up to a factor. Both are found with doubles, since thousands of products and points are tried, and
// then verified with balls. Source: Rota, Strang 1960; Guglielmi, Protasov 2013, "Exact computation of joint spectral
// characteristics of linear operators", Found. Comput. Math. 13 (the polytope).
#include <optional>
#include <vector>

#include "sublimit/certificates/detail/ball_matrix.h"

namespace sublimit {

struct JointSpectralRadius {
  double low = 0, high = 0;       ///< certain
  std::vector<int> product = {};  ///< the indices of factors whose product gives `low`, last factor first
  int vertices = 0;               ///< pairs of them, of the polytope whose norm gives `high`; 0: of another norm
};

struct JointSpectralRadiusOptions {
  int longest = 8;  ///< products tried from below
  int most_products = 40000;
  int most_vertices = 400;    ///< of the polytope
  double least_slack = 1e-7;  ///< relative: polytopes are tried for rates ever closer to the spectral radius
};

/// @param matrices  square, of one size, at least one
JointSpectralRadius joint_spectral_radius(const std::vector<BallMatrix>& matrices,
                                          const JointSpectralRadiusOptions& options = {});

/// The matrices in other coordinates, in which they are small together: joint spectral radii do not change, enclosures
/// get better.
std::vector<BallMatrix> balanced(const std::vector<BallMatrix>& matrices);

/// Certain bound from above of the Euclidean norm of all members: |A|^2 < c where Cholesky's decomposition of c - A^T A
/// is certain to exist.
double euclidean_norm(const BallMatrix& A);

/// Certain bound from below of the spectral radius of all members, from traces of powers: |tr A^k| <= n r(A)^k.
double spectral_radius_below(BallMatrix A);

/// Certain bound from below that a product gives: its spectral radius to the power of 1/length. Last factor first.
double product_radius(const std::vector<BallMatrix>& matrices, const std::vector<int>& factors);

/// Certain bound from above that a norm max |row x| gives: of a polytope whose first rows are a multiple > 0 of the
/// identity; else infinity.
/// @param level  where given, bounds below it are not wanted: that takes less time
double norm_bound(const std::vector<BallMatrix>& matrices, const Eigen::MatrixXd& polytope,
                  std::optional<double> level = {});

}  // namespace sublimit
