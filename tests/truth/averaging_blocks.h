// SPDX-License-Identifier: Apache-2.0
#pragma once
// Repeated averaging around a centre of n sectors, implemented independently from the paper, without a mesh, as
// the reference for the laws on averaging schemes. Points are (s; x, y): x steps along side s of a sector and y
// steps along the next side. Functions that are multiplied by w^k from sector to sector, w = exp(2 pi i/n), are
// functions of (x, y). Sources: Zorin, Schroeder 2001, "A unified framework for primal/dual quadrilateral
// subdivision schemes"; Stam 2001.
#include <Eigen/Core>

namespace sublimit::testing {

/// Returns Fourier block k of one step, for degrees from 2 to 9, on the points of the smallest closed set of
/// rings. Point 0 is the centre (odd degree) or the corner of the n-gon at the centre (even degree).
Eigen::MatrixXcd averaging_block(int degree, int n, int k);

/// Returns the weight of point 0 in the limit at the centre, from the left eigenvector of block 0 for the
/// eigenvalue 1, by power iteration.
double averaging_limit(int degree, int n);

/// Returns the largest eigenvalue of block 1, by power iteration.
double averaging_lambda(int degree, int n);

}  // namespace sublimit::testing
