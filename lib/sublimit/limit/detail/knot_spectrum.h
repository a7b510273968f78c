// SPDX-License-Identifier: Apache-2.0
#pragma once
// Spectra of extraordinary vertices and faces between unequal knot intervals, where new knots go in the middle.
#include <complex>
#include <span>
#include <vector>

#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Eigenvalues of the subdivision matrix of two rings of quadrilaterals around a vertex, by falling modulus. The
/// interval of a spoke is that of all edges which run like it, so that halving leaves the neighbourhood as it is. Of a
/// dual scheme: of the corners of a face and the points around them; towards the corner before each has interval 1.
/// @param scheme     with NewKnots::halving
/// @param intervals  of the spokes, or of corners towards the next one, counter-clockwise, > 0; three at least
/// @throws InvalidParameter  another rule for new knots, fewer of them, intervals that are not positive
std::vector<std::complex<double>> knot_spectrum(const Scheme<double>& scheme, std::span<const double> intervals);

}  // namespace sublimit
