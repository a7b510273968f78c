// SPDX-License-Identifier: Apache-2.0
#pragma once
// Spectra of extraordinary vertices and faces with unequal knot intervals, for schemes that halve intervals.
#include <complex>
#include <span>
#include <vector>

#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Returns the eigenvalues of the local subdivision matrix at a centre, by descending modulus.
///
/// Primal schemes: of two rings of quadrilaterals around a vertex. All edges opposite to a spoke have the
/// interval of the spoke, so that halving reproduces the neighbourhood. Dual schemes: of the corners of a face
/// and the points around them; the interval from a corner to the previous one is 1.
/// @param scheme     a scheme with NewKnots::halving
/// @param intervals  intervals of the spokes, or from each corner to the next, counter-clockwise; > 0, at least
///                   three
/// @throws InvalidParameter  another rule for new knots, fewer than three intervals, or one that is not
///                           positive
std::vector<std::complex<double>> knot_spectrum(const Scheme<double>& scheme, std::span<const double> intervals);

}  // namespace sublimit
