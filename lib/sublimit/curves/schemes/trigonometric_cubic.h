// SPDX-License-Identifier: Apache-2.0
#pragma once
// Splines of pieces 1, x, cos(angle x), sin(angle x), C^2 like cubic ones: Jena, Shunmugaraj, Das 2003, "A subdivision
// algorithm for trigonometric spline curves"; Dyn, Levin, Luzzatto 2003, "Exponentials reproducing subdivision
// schemes". From level k to the next the symbol is (1+z)^2 (1 + 2 c z + z^2)/(4 (1 + c)), c = cos(angle/2^(k+1)): it
// depends on the level, and becomes the one of cubic B-splines. The vertices of a regular polygon that turns by `angle`
// give a circle.
#include <cmath>

#include "sublimit/curves/schemes/curve_ends.h"

namespace sublimit {

template <class T>
CurveScheme<T> trigonometric_cubic(const SchemeOptions& options) {
  const OptionInfo sides{.name = "sides",
                         .values = {"6"},
                         .meaning =
                             "the regular polygon of that many sides has a circle as limit; more is nearer to cubic "
                             "B-splines",
                         .range = OptionRange{{3, 1}, {100000, 1}, true}};
  const OptionInfo ends{.name = "ends",
                        .values = {"free", "interpolate"},
                        .meaning = "free starts an edge after the first point, interpolate in that point"};
  const int n = whole_option(options, sides);
  const auto cosine = [n](const CurveSite<T>& p) {  // of half an angle of the level
    using std::sqrt;
    T c = p.cos_2pi(1, 2 * n);
    for (int k = 0; k < p.level() && c != T(1); ++k) c = sqrt((1 + c) / 2);
    return c;
  };
  return {.name = "trigonometric-cubic",
          .source = "Jena, Shunmugaraj, Das 2003, A subdivision algorithm for trigonometric spline curves",
          .masks = {.point =
                        [cosine](const CurveSite<T>& p) {
                          const T c = cosine(p);
                          return (p.point(-1) + (2 + 4 * c) * p.point(0) + p.point(1)) / (4 + 4 * c);
                        },
                    .edge = [](const CurveSite<T>& p) { return (p.point(0) + p.point(1)) / 2; }},
          .ends = spline_ends<T>(options, ends),
          .claims = {.regular = 2,
                     .generates = 1,
                     .reproduces = 1,
                     .convex_hull = true,
                     .limit = "trigonometric spline, order 4",
                     .exponent = "3"},
          .options = {sides, ends}};
}

}  // namespace sublimit
