// SPDX-License-Identifier: Apache-2.0
#pragma once
// Interface of classical curves that are linear in their control points, as Patch is for surfaces and LimitCurve for
// schemes. A kind of curve defines its stencils; evaluation with normals and poles of rational curves is here.
//
//   const SplineCurve spline(bezier_knots<double>(3));
//   const LinearCurve& curve = spline;
//   const Points control{{0, 0}, {1, 2}, {3, 2}, {4, 0}};
//   const CurveSamples samples = curve.evaluate(control, std::vector<CurvePlace>{curve.place(0.5)}, 2);
#include <span>

#include "sublimit/curves/limit_curve.h"
#include "sublimit/patches/knots.h"
#include "sublimit/patches/rational.h"

namespace sublimit {

/// One curve or several, without control points. It never changes: threads may share it.
class CurveSource {
 public:
  virtual ~CurveSource() = default;

  virtual Index num_segments() const = 0;
  /// Returns the number of control points.
  virtual Index num_points() const = 0;

  /// Returns the weights over the control points: position, then derivatives per unit of the segment's t. At a knot
  /// they are those of the segment's side. The status is `crease` if a row that was asked for differs on the other
  /// side, else `regular`.
  /// @throws InvalidParameter  a segment that does not exist, t outside [0, 1] or not finite, another order than 0 to 2
  virtual CurveStencil stencil(const CurvePlace& place, int order = 0) const = 0;

  /// Returns points with derivatives and normals; in parallel. A place where w = 0 has the status `pole` and nothing
  /// else.
  /// @param columns  control points, #points x dimension, and one column more if they are homogeneous
  /// @param order    number of derivatives: 0, 1 or 2
  /// @throws InvalidParameter  a place as in `stencil`: names its row; an array of another size
  CurveSamples evaluate(const Points& columns, std::span<const CurvePlace> places, int order = 0,
                        Coordinates coordinates = Coordinates::plain) const;

 protected:
  CurveSource() = default;
  CurveSource(const CurveSource&) = default;
  CurveSource(CurveSource&&) = default;
  CurveSource& operator=(const CurveSource&) = default;
  CurveSource& operator=(CurveSource&&) = default;
};

/// One curve, with a parameter of its own.
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
