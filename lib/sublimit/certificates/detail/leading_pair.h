// SPDX-License-Identifier: Apache-2.0
#pragma once
// The leading eigenvalue of a Fourier block, its eigenvector, and the proof that all others are smaller, in balls.
#include <optional>
#include <vector>

#include "sublimit/certificates/complex_ball.h"
#include "sublimit/neighborhood/local_matrix.h"

namespace sublimit {

struct LeadingPair {
  ComplexBall value;
  std::vector<ComplexBall> vector;  ///< scaled so that component `unit` is exactly one
  size_t unit = 0;
};

/// Encloses the eigenvalue of largest modulus (as far as floating numbers see) and its eigenvector, by Rump's method.
/// Nothing where it is not isolated enough for that.
std::optional<LeadingPair> leading_pair(const DenseMatrix<ComplexBall>& B);

/// B without one eigenvalue: (I - x e^T) B has those of B, but 0 in the place of x's, for an eigenvector x with
/// component `unit` one (Wielandt's deflation).
DenseMatrix<ComplexBall> deflated(const DenseMatrix<ComplexBall>& B, const std::vector<ComplexBall>& x, size_t unit);

/// Proves that all eigenvalues are smaller than `bound`: ||B^m|| < bound^m for some m = 2, 4, 8 ... 2^most.
/// @return  m, or nothing where no m shows it
std::optional<long> power_below(DenseMatrix<ComplexBall> B, const Ball& bound, int most = 14);

}  // namespace sublimit
