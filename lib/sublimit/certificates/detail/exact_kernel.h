// SPDX-License-Identifier: Apache-2.0
#pragma once
// Null spaces of B - lambda for an eigenvalue lambda, exactly: linear algebra over K(lambda) = K[x]/(g), g(lambda) = 0.
// Where a pivot turns out to be neither zero nor invertible, g falls apart, and the factor that has lambda as its root
// goes on (dynamic evaluation: Della Dora, Dicrescenzo, Duval 1985).
#include <optional>
#include <vector>

#include "sublimit/certificates/detail/algebraic_root.h"

namespace sublimit {

/// Vectors over K(lambda): an entry is a polynomial in lambda, of degree below that of `modulus`.
struct ExactKernel {
  AlgebraicRoot lambda;
  Polynomial modulus;                            ///< g
  std::vector<std::vector<Polynomial>> vectors;  ///< a basis of the null space; B x = lambda x modulo g

  /// Vector i, in balls.
  std::vector<ComplexBall> enclosure(int i, long bits = 128) const;
};

/// Eigenvectors of lambda, a basis. Right ones; left ones are those of the transposed matrix.
ExactKernel exact_eigenvectors(const DenseMatrix<Algebraic>& B, const AlgebraicRoot& lambda);

/// The eigenvector of lambda in balls, where it is certain that there is but one, up to its length: no number is
/// reduced, which exactly takes minutes where matrices are large. Nothing: there may be several.
/// @param bits  of working precision
std::optional<std::vector<ComplexBall>> enclosed_eigenvector(const DenseMatrix<Algebraic>& B,
                                                             const AlgebraicRoot& lambda, long bits = 128);

/// Returns the ends of Jordan chains of a length: (B - lambda)^(length - 1) u over a basis of the u with
/// (B - lambda)^length u = 0. They span the eigenvectors that dominate powers of B if such chains do; some may be zero.
ExactKernel exact_chain_ends(const DenseMatrix<Algebraic>& B, const AlgebraicRoot& lambda, int length);

/// Sizes of the Jordan blocks of lambda, descending.
/// @param multiplicity  algebraic
std::vector<int> jordan_sizes(const DenseMatrix<Algebraic>& B, const AlgebraicRoot& lambda, int multiplicity);

}  // namespace sublimit
