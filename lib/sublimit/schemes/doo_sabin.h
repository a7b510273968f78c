// SPDX-License-Identifier: Apache-2.0
#pragma once
// Doo, Sabin 1978, "Behaviour of recursive division surfaces near extraordinary points": weights with cosines, and the
// variant that averages a corner with the centroid and the midpoints of its two edges. Border: the points of Chaikin's
// curve of the border polygon (Nasri 1987 ends there too), so that the limit ends in its quadratic B-spline, whatever
// is inside. Corners are rounded.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

template <class T, class Weight>
Scheme<T> doo_sabin_with(const char* name, const char* source, const Weight& weight) {
  const Step<T> step{.split = Split::dqq, .masks = {.corner = [=](const FaceSite<T>& f) {
                                            Stencil<T> sum;
                                            for (int j = 0; j < f.size(); ++j) sum += weight(f, j) * f.corner(j);
                                            return sum;
                                          }}};
  return {.name = name,
          .source = source,
          .steps = {step},
          .creases = {.edge = [](const CreaseEdgeSite<T>& e) { return (3 * e.tail() + e.head()) / 4; }},
          .claims = {.regular = 1,
                     .extraordinary = 1,
                     .generates = 2,
                     .reproduces = 1,
                     .convex_hull = true,
                     .limit = "biquadratic B-spline"},
          .sharpening = Sharpening::boundary};
}

template <class T>
Scheme<T> doo_sabin(const SchemeOptions&) {
  return doo_sabin_with<T>("doo-sabin",
                           "Doo, Sabin 1978, Behaviour of recursive division surfaces near extraordinary points",
                           [](const FaceSite<T>& f, int j) {
                             const int n = f.size();
                             return j == 0 ? f.ratio(n + 5, 4 * n) : (T(3) + 2 * f.cos_2pi(j, n)) / (4 * n);
                           });
}

template <class T>
Scheme<T> doo_sabin_averaging(const SchemeOptions&) {
  return doo_sabin_with<T>("doo-sabin-averaging",
                           "Doo, Sabin 1978 with the weights of repeated averaging: Zorin, Schroeder 2001",
                           [](const FaceSite<T>& f, int j) {
                             const int n = f.size();
                             const T own = j == 0 ? f.ratio(1, 2) : j == 1 || j == n - 1 ? f.ratio(1, 8) : T(0);
                             return own + f.ratio(1, 4 * n);
                           });
}

}  // namespace sublimit
