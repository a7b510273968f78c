// SPDX-License-Identifier: Apache-2.0
#pragma once
// Conjugate gradients for all channels at once, each with its own step lengths: they share every pass over the matrix.
// Sums run over blocks of rows, so the bits do not depend on the number of threads.
// Source: Hestenes, Stiefel 1952, "Methods of conjugate gradients for solving linear systems".
#include <functional>

#include "sublimit/core/types.h"

namespace sublimit {

/// Solves S u = right from u = 0, where S is symmetric and positive semidefinite.
/// @param S         returns S * p
/// @param diagonal  diagonal preconditioner, >= 0, of about the size of S; entries of u where it is zero stay
///                  zero
/// @param residual  on entry the right-hand side, on return the residual right - S u
/// @param go_on     called after each iteration with its number and the largest entry of the residual; false stops
/// @return  u
Points conjugate_gradients(const std::function<Points(const Points&)>& S, const Eigen::VectorXd& diagonal,
                           Points& residual, const std::function<bool(int, double)>& go_on);

/// Solves min |C u - gap| from u = 0 by conjugate gradients for least squares: C^T is applied to the residual
/// gap, which is more accurate than forming C^T C. All steps lie in the range of C^T.
/// Source: Bjorck 1996, "Numerical methods for least squares problems", section 7.4.
/// @param gap    on entry the right-hand side, on return the residual gap - C u
/// @param go_on  called after each iteration with its number and the largest entries of the gap and of C^T gap
Points least_squares_gradients(const SparseMatrix& C, const SparseMatrix& Ct, Points& gap,
                               const std::function<bool(int, double, double)>& go_on);

}  // namespace sublimit
