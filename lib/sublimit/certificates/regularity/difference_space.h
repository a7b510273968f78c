// SPDX-License-Identifier: Apache-2.0
#pragma once
// Differences of order m of points on a regular mesh, and what one level makes of them: functionals that vanish on
// polynomials of degree below m. Those of finer levels are combinations of finitely many of the level before, moved to
// the cell in question: one matrix for each of the cells that a cell is cut into. Their joint spectral radius says how
// fast differences shrink. Source: Jia 1995, Subdivision schemes in L_p spaces; Cavaretta, Dahmen, Micchelli 1991,
// Stationary subdivision, chapters 2 and 8.
#include "sublimit/certificates/regularity/smoothness.h"
#include "sublimit/neighborhood/regular_mask.h"

namespace sublimit {

/// A functional of points: weights by place.
using Functional = std::map<Offset, Rational>;

/// Values of the basis function at the points' own places, exact: a functional of the points around the origin whose
/// value is the limit there. Empty where the eigenvalue 1 is not simple. Of dual schemes: at the place half a step off
/// (a face's centre).
Functional limit_functional(const RegularMask<Rational>& mask);

/// Transition matrices of the smallest space of functionals that has all differences of order m (composed with `first`,
/// if it is not empty) and goes to itself under refinement.
/// @pre  polynomials of degree below m are generated
/// @throws AnalysisError  more than `largest` dimensions
DifferenceTransitions difference_transitions(const RegularMask<Rational>& mask, int m, const Functional& first = {},
                                             int largest = 400);

/// Limits of polynomials of this degree are polynomials: all higher differences of them vanish. Where shifts of the
/// basis function are dependent, degrees above those that masks generate level by level can be among these (Zwart,
/// Powell: 2).
/// @param values  limit_functional(mask), not empty
bool generates(const RegularMask<Rational>& mask, const Functional& values, int degree);

}  // namespace sublimit
