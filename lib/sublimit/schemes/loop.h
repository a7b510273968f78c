// SPDX-License-Identifier: Apache-2.0
#pragma once
// Loop 1987, "Smooth subdivision surfaces based on triangles" (MSc thesis, Utah).
// Warren 1995, "Subdivision methods for geometric design" (notes): weights 3/16 and 3/(8n) without cosines.
#include "sublimit/scheme/cubic_bspline_creases.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Loop's scheme with beta(ring), the total weight of the neighbours.
template <class T, class Beta>
Scheme<T> loop_with(const char* name, const char* source, const Beta& beta) {
  return {.name = name,
          .source = source,
          .steps = {{.split = Split::ptq,
                     .masks = {.vertex =
                                   [=](const Ring<T>& v) {
                                     const T b = beta(v);
                                     return (T(1) - b) * v.center() + b * v.neighbor_mean();
                                   },
                               .edge =
                                   [](const EdgeSite<T>& e) {
                                     return (3 * (e.tail() + e.head()) + e.left_face().corner(2) +
                                             e.right_face().corner(2)) /
                                            8;
                                   }}}},
          .creases = cubic_bspline_creases<T>(),
          .claims = {.regular = 2,
                     .extraordinary = 1,
                     .generates = 3,
                     .reproduces = 1,
                     .convex_hull = true,
                     .limit = "quartic box spline"}};
}

template <class T>
Scheme<T> loop(const SchemeOptions&) {
  return loop_with<T>("loop", "Loop 1987, Smooth subdivision surfaces based on triangles", [](const Ring<T>& v) {
    const T a = v.ratio(3, 8) + v.cos_2pi(1, v.valence()) / 4;
    return v.ratio(5, 8) - a * a;
  });
}

template <class T>
Scheme<T> loop_warren(const SchemeOptions&) {
  return loop_with<T>("loop-warren", "Warren 1995, Subdivision methods for geometric design",
                      [](const Ring<T>& v) { return v.valence() == 3 ? v.ratio(9, 16) : v.ratio(3, 8); });
}

}  // namespace sublimit
