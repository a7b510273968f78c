// SPDX-License-Identifier: Apache-2.0
#pragma once
// Repeated averaging around a centre of n sectors, written down anew from the paper, without a mesh: points are (s; x,
// y), x steps along side s of a sector and y along the next, and functions that turn by w^k from sector to sector, w =
// exp(2 pi i/n), are functions of (x, y) alone. What laws hold the library's averaging against. Sources: Zorin,
// Schroeder 2001, "A unified framework for primal/dual quadrilateral subdivision schemes"; Stam 2001.
#include <Eigen/Core>

namespace sublimit::testing {

/// Block k of one step of a degree from 2 to 9: Fourier modes on the points of the rings that close it. Point 0 is the
/// centre (degree odd) or the corner of the n-gon in the centre (even).
Eigen::MatrixXcd averaging_block(int degree, int n, int k);

/// Weight of point 0 in the limit at the centre: the eigenvector of block 0 to the eigenvalue 1, by power iteration.
double averaging_limit(int degree, int n);

/// The largest eigenvalue of block 1, by power iteration.
double averaging_lambda(int degree, int n);

}  // namespace sublimit::testing
