// SPDX-License-Identifier: Apache-2.0
#pragma once
// The leading eigenvalue of a Fourier block, its eigenvector, and the proof that all others are smaller, in balls.
#include <optional>
#include <vector>

#include "sublimit/certificates/numbers/complex_ball.h"
#include "sublimit/neighborhood/local_matrix.h"

namespace sublimit {

/// An eigenvalue with its eigenvector.
struct LeadingPair {
  ComplexBall value;
  std::vector<ComplexBall> vector;  ///< scaled so that component `unit` is exactly one
  size_t unit = 0;
};

/// Returns enclosures of the eigenvalue of largest modulus (chosen in floating-point arithmetic) and its
/// eigenvector, by Rump's method; nothing if it is not isolated enough.
std::optional<LeadingPair> leading_pair(const DenseMatrix<ComplexBall>& B);

/// Returns B with one eigenvalue replaced by 0, by Wielandt's deflation: (I - x e^T) B, where x is an
/// eigenvector with component `unit` one, and e the unit vector of this component.
DenseMatrix<ComplexBall> deflated(const DenseMatrix<ComplexBall>& B, const std::vector<ComplexBall>& x, size_t unit);

/// Proves that all eigenvalues are smaller than `bound` in modulus: ||B^m|| < bound^m for some m = 2, 4, 8 ...
/// 2^most.
/// @return  m; nothing if no m is a proof
std::optional<long> power_below(DenseMatrix<ComplexBall> B, const Ball& bound, int most = 14);

}  // namespace sublimit
