// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polynomial curves in other bases, converted to B-splines: control points are blossoms of the powers
// (power_coefficients.h).
// Source: Ferguson 1964; Coons 1967; Catmull, Rom 1974; the bases of Wavefront's OBJ.
#include <utility>
#include <vector>

#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// Returns a Bezier curve over [begin, end].
/// @throws InvalidParameter  a degree that is not 0 to max_degree, or begin >= end
CurveNet bezier_curve(Points points, double begin = 0, double end = 1, Coordinates coordinates = Coordinates::plain);

/// Returns the curve sum a_k t^k over [begin, end].
/// @param coefficients  a_0, a_1, ..: a row each; a_0 is a point, the others are vectors
CurveNet taylor_curve(const Points& coefficients, double begin = 0, double end = 1);

/// Returns the cubic from P0 to P1 with derivatives T0 and T1, over [0, 1].
/// @param points, tangents  2 rows each
CurveNet hermite_curve(const Points& points, const Points& tangents);

/// A curve in segments with a common basis matrix, t from 0 to 1 in each: Hermite, Coons or Catmull-Rom
/// splines.
struct MatrixCurve {
  Eigen::MatrixXd matrix;    ///< (degree + 1)^2; row i has the coefficients of control point i, that of t^0 first
  Index step = 1;            ///< number of control points from the start of a segment to that of the next
  Points points;             ///< degree + 1 + step (#segments - 1) control points
  std::vector<double> ends;  ///< ends of segments, ascending; empty: 0, 1, 2, ..
};
/// Returns the curve as Bezier pieces. It jumps if a segment does not start at the end of the previous one.
/// @throws InvalidParameter  inconsistent counts; names consistent ones
CurveNet matrix_curve(const MatrixCurve& curve);

}  // namespace sublimit
