// SPDX-License-Identifier: Apache-2.0
#pragma once
// Null spaces of B - lambda for an eigenvalue lambda, exactly: linear algebra over K(lambda) = K[x]/(g), g(lambda) = 0.
// If a pivot is neither zero nor invertible, g is factored, and the computation continues with the factor that
// has the root lambda (dynamic evaluation: Della Dora, Dicrescenzo, Duval 1985).
#include <optional>
#include <vector>

#include "sublimit/certificates/numbers/detail/algebraic_root.h"

namespace sublimit {

/// Vectors over K(lambda): an entry is a polynomial in lambda, of degree below that of `modulus`.
struct ExactKernel {
  AlgebraicRoot lambda;
  Polynomial modulus;                            ///< g
  std::vector<std::vector<Polynomial>> vectors;  ///< a basis of the null space; B x = lambda x modulo g

  /// Returns an enclosure of vector i.
  std::vector<ComplexBall> enclosure(int i, long bits = 128) const;
};

/// Returns a basis of the right eigenvectors of lambda. Left ones are those of the transposed matrix.
ExactKernel exact_eigenvectors(const DenseMatrix<Algebraic>& B, const AlgebraicRoot& lambda);

/// Returns an enclosure of the eigenvector of lambda, if it is certainly unique up to scaling. Avoids exact
/// elimination, which takes minutes for large matrices.
/// @param bits  working precision
/// @return  nothing if there may be several
std::optional<std::vector<ComplexBall>> enclosed_eigenvector(const DenseMatrix<Algebraic>& B,
                                                             const AlgebraicRoot& lambda, long bits = 128);

/// Returns the ends of Jordan chains of a length: (B - lambda)^(length - 1) u over a basis of the u with
/// (B - lambda)^length u = 0. They span the eigenvectors that dominate powers of B if such chains do; some may be zero.
ExactKernel exact_chain_ends(const DenseMatrix<Algebraic>& B, const AlgebraicRoot& lambda, int length);

/// Returns the sizes of the Jordan blocks of lambda, descending.
/// @param multiplicity  algebraic multiplicity of lambda
std::vector<int> jordan_sizes(const DenseMatrix<Algebraic>& B, const AlgebraicRoot& lambda, int multiplicity);

}  // namespace sublimit
