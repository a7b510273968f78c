// SPDX-License-Identifier: Apache-2.0
#pragma once
// One space of splines that several curves are in: the highest degree, and every knot as often as any of them needs.
// The way there is elevation and insertion, both exact.
// Source: Piegl, Tiller 1997, "The NURBS Book", section 8.2 (making curves compatible).
#include <span>
#include <vector>

#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// Knots of a space that has all the curves of others. Knots that are all the same stay as they are; else ends are
/// interpolated, and closed curves opened.
/// @param degree   at least
/// @param clamped  ends interpolated, whatever the knots are
/// @throws InvalidParameter  other domains than the first one's
Knots<double> common_knots(std::span<const Knots<double>> all, int degree = 0, bool clamped = false);

/// Control points over finer knots of the same degree or a higher one: those of `common_knots`.
/// @return  #points of `fine` x #points of `coarse`
SparseMatrix embedding(const Knots<double>& coarse, const Knots<double>& fine);

CurveNet in_space(const CurveNet& curve, const Knots<double>& fine);

/// Curves over common knots, all of them rational if one is.
/// @param curves  get other knots and columns
Coordinates make_compatible(std::span<CurveNet* const> curves);

}  // namespace sublimit
