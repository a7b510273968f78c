// SPDX-License-Identifier: Apache-2.0
#pragma once
// Crease masks for schemes of your own whose creases and boundaries are uniform cubic B-splines. Source: Hoppe et al.
// 1994, "Piecewise smooth surface reconstruction".
//
//   Scheme<double> mine = *AnyScheme("doo-sabin");
//   mine.creases = cubic_bspline_creases<double>();
#include "sublimit/scheme/sites.h"

namespace sublimit {

/// Returns the masks (1, 6, 1)/8 of a vertex on a crease and (1, 1)/2 of a crease edge.
template <class T>
CreaseMasks<T> cubic_bspline_creases() {
  return {.vertex = [](const CreaseSite<T>& v) { return (v.before() + 6 * v.center() + v.after()) / 8; },
          .edge = [](const CreaseEdgeSite<T>& e) { return (e.tail() + e.head()) / 2; }};
}

}  // namespace sublimit
