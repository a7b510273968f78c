// SPDX-License-Identifier: Apache-2.0
#pragma once
// Joint spectral radius of a set of matrices: the growth rate per factor of their products. Lower bounds are
// spectral radii of finite products; upper bounds are norms of all matrices, in the norm of a polytope that
// they map into itself up to a factor. Both are searched for in doubles, since thousands of products and points
// are tried, and verified with balls. Source: Rota, Strang 1960; Guglielmi, Protasov 2013, "Exact computation
// of joint spectral characteristics of linear operators", Found. Comput. Math. 13 (the polytope).
#include <optional>
#include <vector>

#include "sublimit/certificates/numbers/detail/ball_matrix.h"

namespace sublimit {

/// Bounds of a joint spectral radius.
struct JointSpectralRadius {
  double low = 0, high = 0;       ///< proved bounds
  std::vector<int> product = {};  ///< indices of the factors whose product gives `low`, last factor first
  int vertices = 0;               ///< pairs of vertices of the polytope that gives `high`; 0: from another norm
};

/// Effort of the search.
struct JointSpectralRadiusOptions {
  int longest = 8;            ///< largest number of factors of products for the lower bound
  int most_products = 40000;  ///< largest number of such products
  int most_vertices = 400;    ///< largest number of pairs of vertices of the polytope
  double least_slack = 1e-7;  ///< relative distance to the lower bound at which the search for polytopes ends
};

/// Returns bounds of the joint spectral radius.
/// @param matrices  square, all of one size, at least one
JointSpectralRadius joint_spectral_radius(const std::vector<BallMatrix>& matrices,
                                          const JointSpectralRadiusOptions& options = {});

/// Returns the matrices in coordinates in which they have small norms together. Joint spectral radii do not
/// change, but enclosures get tighter.
std::vector<BallMatrix> balanced(const std::vector<BallMatrix>& matrices);

/// Returns a proved upper bound of the Euclidean norm of all matrices in A: |A|^2 < c if the Cholesky
/// decomposition of c - A^T A certainly exists.
double euclidean_norm(const BallMatrix& A);

/// Returns a proved lower bound of the spectral radius of all matrices in A, from traces of powers: |tr A^k| <=
/// n r(A)^k.
double spectral_radius_below(BallMatrix A);

/// Returns the proved lower bound from a product: its spectral radius to the power of 1/length.
/// @param factors  indices of its factors, last factor first
double product_radius(const std::vector<BallMatrix>& matrices, const std::vector<int>& factors);

/// Returns the proved upper bound from the norm whose unit ball is the symmetric hull of a polytope's rows.
/// @param polytope  its first rows must be a multiple > 0 of the identity, else the result is infinity
/// @param level     if given, no effort is made to find bounds below it, which saves time
double norm_bound(const std::vector<BallMatrix>& matrices, const Eigen::MatrixXd& polytope,
                  std::optional<double> level = {});

}  // namespace sublimit
