// SPDX-License-Identifier: Apache-2.0
#pragma once
// Chaikin 1974, "An algorithm for high-speed curve generation": corners are cut at a quarter and three quarters of
// every edge. Riesenfeld 1975, "On Chaikin's algorithm": the limit is the uniform quadratic B-spline.
#include "sublimit/curves/schemes/curve_ends.h"

namespace sublimit {

template <class T>
CurveScheme<T> chaikin(const SchemeOptions& options) {
  const OptionInfo ends{.name = "ends",
                        .values = {"free", "interpolate"},
                        .meaning = "free starts in the middle of the first edge, interpolate in the first point"};
  return {.name = "chaikin",
          .source = "Chaikin 1974, An algorithm for high-speed curve generation",
          .masks = {.before = [](const CurveSite<T>& p) { return (p.point(-1) + 3 * p.point(0)) / 4; },
                    .after = [](const CurveSite<T>& p) { return (3 * p.point(0) + p.point(1)) / 4; }},
          .ends = spline_ends<T>(options, ends),
          .claims = {.regular = 1,
                     .generates = 2,
                     .reproduces = 1,
                     .convex_hull = true,
                     .limit = "quadratic B-spline",
                     .exponent = "2"},
          .options = {ends}};
}

}  // namespace sublimit
