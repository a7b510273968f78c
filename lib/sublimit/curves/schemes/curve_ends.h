// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rules for open ends that several curve schemes share. They are applied to the polygon of every level, and are
// stationary: the rows are the same on every level.
#include "sublimit/curves/curve_scheme.h"

namespace sublimit {

/// Returns the rule that continues the polygon by its point reflection in the end point. Refinement by a
/// symmetric mask keeps that symmetry, so the refined polygon ends like the coarse one and the limit starts in
/// the end point, along the first edge, with curvature zero (the natural end of splines). Dual schemes of
/// degree 2 give the quadratic B-spline with a triple end knot.
template <class T>
CurveEnds<T> reflected_ends() {
  return {.beyond = [](const CurveEnd<T>& end, int m) { return 2 * end.point(0) - end.point(m); }, .points = 2};
}

/// Returns the rule that continues the polygon by the polynomial of this degree through the first degree + 1
/// points.
template <class T>
CurveEnds<T> extrapolated_ends(int degree) {
  return {.beyond =
              [degree](const CurveEnd<T>& end, int m) {
                Stencil<T> sum;
                for (int j = 0; j <= degree; ++j) {  // Lagrange's weights of 0..degree at -m
                  T weight(1);
                  for (int i = 0; i <= degree; ++i)
                    if (i != j) weight *= end.ratio(-m - i, 1);
                  for (int i = 0; i <= degree; ++i)
                    if (i != j) weight /= end.ratio(j - i, 1);
                  sum += weight * end.point(j);
                }
                return sum;
              },
          .points = degree + 1};
}

/// Returns the ends for an option of the B-spline schemes: `free` omits points that depend on points beyond the
/// end, `interpolate` reflects the polygon.
template <class T>
CurveEnds<T> spline_ends(const SchemeOptions& options, const OptionInfo& info) {
  return option(options, info) == "free" ? CurveEnds<T>{} : reflected_ends<T>();
}

}  // namespace sublimit
