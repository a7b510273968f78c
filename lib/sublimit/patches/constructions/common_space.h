// SPDX-License-Identifier: Apache-2.0
#pragma once
// A common spline space of several curves: the highest degree, and every knot with the highest multiplicity.
// Curves are converted by degree elevation and knot insertion, both exact.
// Source: Piegl, Tiller 1997, "The NURBS Book", section 8.2 (making curves compatible).
#include <span>
#include <vector>

#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// Returns the knots of a space that contains all curves over the given knots. Equal knots are returned
/// unchanged; otherwise ends are interpolated, and closed curves opened.
/// @param degree   least degree of the result
/// @param clamped  true: interpolate ends in any case
/// @throws InvalidParameter  domains differ
Knots<double> common_knots(std::span<const Knots<double>> all, int degree = 0, bool clamped = false);

/// Returns the matrix to control points over finer knots of the same or a higher degree, from `common_knots`.
/// @return  #points of `fine` x #points of `coarse`
SparseMatrix embedding(const Knots<double>& coarse, const Knots<double>& fine);

/// Returns a curve over finer knots.
CurveNet in_space(const CurveNet& curve, const Knots<double>& fine);

/// Converts curves to common knots, and all to rational ones if one is rational.
/// @param curves  converted in place
/// @return  coordinates of their columns
Coordinates make_compatible(std::span<CurveNet* const> curves);

}  // namespace sublimit
