// SPDX-License-Identifier: Apache-2.0
#pragma once
// Refinement of differences of order m of points on a regular mesh: functionals that vanish on polynomials of
// degree below m. Differences on a level are combinations of finitely many ones on the level before, in the
// cell around: one matrix for each child cell. Their joint spectral radius is the rate at which differences
// shrink. Source: Jia 1995, Subdivision schemes in L_p spaces; Cavaretta, Dahmen, Micchelli 1991, Stationary
// subdivision, chapters 2 and 8.
#include "sublimit/certificates/regularity/smoothness.h"
#include "sublimit/neighborhood/regular_mask.h"

namespace sublimit {

/// A functional of points: weights by place.
using Functional = std::map<Offset, Rational>;

/// Returns the exact values of the basis function at grid points: the functional of the points around the
/// origin whose value is the limit at the origin; for dual schemes at the centre of a face. Empty if the
/// eigenvalue 1 is not simple.
Functional limit_functional(const RegularMask<Rational>& mask);

/// Returns the transition matrices of the smallest space of functionals that contains all differences of order
/// m (composed with `first`, if not empty) and is invariant under refinement.
/// @pre  polynomials of degree below m are generated
/// @throws AnalysisError  the space has more than `largest` dimensions
DifferenceTransitions difference_transitions(const RegularMask<Rational>& mask, int m, const Functional& first = {},
                                             int largest = 400);

/// True if limits of polynomials of this degree are polynomials: all their higher differences vanish. If shifts
/// of the basis function are dependent, this can hold for degrees above those that masks generate on each level
/// (Zwart-Powell: 2).
/// @param values  limit_functional(mask), not empty
bool generates(const RegularMask<Rational>& mask, const Functional& values, int degree);

}  // namespace sublimit
