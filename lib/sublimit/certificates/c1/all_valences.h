// SPDX-License-Identifier: Apache-2.0
#pragma once
// C^1 at extraordinary points of all valences n >= 3 at once.
//
// Small valences are certified one by one. For the others, block 1 is a matrix of polynomials in h = cos(pi/n)
// (valence_family.h), and [cos(pi/first), 1] is covered by intervals: on each of them balls enclose the leading
// eigenvalue and the characteristic net for all h of the interval, and the proof is that of map_proof.h. What vanishes
// with the angle of a sector, the imaginary parts and the Jacobian determinant, is divided by sin(pi/n), so h = 1, the
// limit of infinite valence, is covered too. The other eigenvalues are smaller:
//
//   blocks 2 ... n - 2  are the same matrix at h' = cos(pi k/n) <= 2 h^2 - 1. Their eigenvalues are below lambda(h) on
//                       intervals of h'; and where h' is in the range that was covered, because lambda increases with h
//                       (dlambda/dh = y^T R' x / y^T x > 0, x and y the eigenvectors of R and of its transpose).
//   block 0             without its eigenvalue 1, on intervals of 1/n. Where it comes arbitrarily close to lambda as n
//                       grows (Catmull-Clark), the rest of block 0 is L(1) - 1 r^T with the row r = O(1/n) of the
//                       centre; it is not negative, so the Collatz-Wielandt quotients of the leading vector of L(1)
//                       bound its eigenvalues by lambda(1) - O(1/n), and lambda(h) is lambda(1) - O(1/n^2) at least.
#include <optional>
#include <vector>

#include "sublimit/certificates/c1/c1_certificate.h"

namespace sublimit {

/// An interval of h = cos(pi/n).
struct ValenceInterval {
  Ball h;
  Ball lambda;            ///< encloses the leading eigenvalue of block 1 for every h of the interval
  Ball slope;             ///< encloses dlambda/dh
  std::vector<Ball> net;  ///< encloses the unknowns of `real_block` for sector 0, the greatest scaled to 1
  Ball least;             ///< lower bound of the Jacobian determinant divided by sin(pi/n)
};

/// Verdict and evidence for all valences.
struct AllValences {
  Verdict verdict;
  int first = 0;                           ///< the least valence that is not certified individually
  std::vector<ValenceInterval> intervals;  ///< by increasing h
};

/// Returns the verdict on all valences n >= 3.
///
/// It rests on an assumption that cannot be tested: masks are code, which is only evaluated up to some valence.
/// The verdict is about masks that continue in the same way for larger valences, and says so.
/// @param first  valences below this are certified one by one; at least 7
/// @throws InvalidParameter  `first` below 7
AllValences all_valences(const C1Prover& prover, int first = 7);

}  // namespace sublimit
