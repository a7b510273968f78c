// SPDX-License-Identifier: Apache-2.0
#pragma once
// Interface of one classical curve, which has a parameter of its own, as Patch is for surfaces. A kind of curve defines
// its stencils, places and lengths.
//
//   const SplineCurve spline(bezier_knots<double>(3));
//   const LinearCurve& curve = spline;
//   const Points control{{0, 0}, {1, 2}, {3, 2}, {4, 0}};
//   const CurveSamples samples = curve.evaluate(control, std::vector<CurvePlace>{curve.place(0.5)}, 2);
#include "sublimit/curves/curve_source.h"
#include "sublimit/patches/knots.h"

namespace sublimit {

/// One curve, with a parameter of its own. At a knot its stencils are those of the segment's side.
class LinearCurve : public CurveSource {
 public:
  /// Returns the place of a parameter.
  /// @param side  piece that a knot belongs to
  /// @throws InvalidParameter  a parameter outside the domain, which the message has
  virtual CurvePlace place(double t, KnotSide side = KnotSide::right) const = 0;
  /// Returns the length of a segment in the curve's parameter. Derivatives by that parameter are those of the segment
  /// divided by this length.
  virtual double length(Index segment) const = 0;
};

}  // namespace sublimit
