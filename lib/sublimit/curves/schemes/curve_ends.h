// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rules for open ends that several curve schemes share. All of them are made anew from the polygon of every level, and
// all are stationary: the same rows at every level.
#include "sublimit/curves/curve_scheme.h"

namespace sublimit {

/// Beyond the end lies the point reflection of the polygon in its end point. Refinement by a symmetric mask keeps that
/// symmetry, so the refined polygon ends like the coarse one and the limit starts in the end point, along the first
/// edge, with curvature zero (the natural end of splines). Dual schemes of degree 2 give the quadratic B-spline with a
/// triple end knot.
template <class T>
CurveEnds<T> reflected_ends() {
  return {.beyond = [](const CurveEnd<T>& end, int m) { return 2 * end.point(0) - end.point(m); }, .points = 2};
}

/// Beyond the end the polynomial of this degree through the first degree + 1 points goes on.
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

/// Option of the B-spline schemes: `free` leaves out what needs points beyond the end, `interpolate` reflects the
/// polygon.
template <class T>
CurveEnds<T> spline_ends(const SchemeOptions& options, const OptionInfo& info) {
  return option(options, info) == "free" ? CurveEnds<T>{} : reflected_ends<T>();
}

}  // namespace sublimit
