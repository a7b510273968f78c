// SPDX-License-Identifier: Apache-2.0
#pragma once
// Crease curves that are uniform cubic B-splines: Hoppe et al. 1994, "Piecewise smooth surface reconstruction".
#include "sublimit/scheme/sites.h"

namespace sublimit {

template <class T>
CreaseMasks<T> cubic_bspline_creases() {
  return {.vertex = [](const CreaseSite<T>& v) { return (v.before() + 6 * v.center() + v.after()) / 8; },
          .edge = [](const CreaseEdgeSite<T>& e) { return (e.tail() + e.head()) / 2; }};
}

}  // namespace sublimit
