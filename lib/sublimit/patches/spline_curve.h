// SPDX-License-Identifier: Apache-2.0
#pragma once
// B-spline curves. Segments are the spans of the knots that are not empty; derivatives are per unit of a segment's t.
//
//   const SplineCurve curve(Knots<double>::open(2, 4, {0, 0, 0, 1, 3, 3, 3}));
//   const Points control{{0, 0}, {1, 2}, {3, 2}, {4, 0}};
//   const std::vector<CurvePlace> places = {curve.place(0.5), curve.place(2)};
//   const CurveSamples samples = curve.evaluate(control, places, 1);
#include "sublimit/patches/knots.h"
#include "sublimit/patches/linear_curve.h"

namespace sublimit {

/// A B-spline curve without control points. It never changes: threads may share it.
class SplineCurve : public LinearCurve {
 public:
  /// Makes the curve of some knots.
  explicit SplineCurve(Knots<double> knots) : knots_(std::move(knots)) {}

  const Knots<double>& knots() const { return knots_; }
  Index num_segments() const override { return knots_.num_faces(); }
  Index num_points() const override { return knots_.num_points(); }

  /// Returns the place of a parameter of the knots.
  /// @throws InvalidParameter  a parameter outside the domain
  CurvePlace place(double t, KnotSide side = KnotSide::right) const override;
  /// Returns the parameter of a place.
  double parameter(const CurvePlace& place) const { return knots_.parameter({place.segment, place.t}); }

  double length(Index segment) const override { return knots_.length(segment); }

  /// Returns the stencil of a place; at knots it is that of the segment's side.
  CurveStencil stencil(const CurvePlace& place, int order = 0) const override;

 private:
  Knots<double> knots_;
};

}  // namespace sublimit
