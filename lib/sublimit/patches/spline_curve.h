// SPDX-License-Identifier: Apache-2.0
#pragma once
// A B-spline curve as a linear source: what LimitCurve is for curve schemes. Segments are the spans of its knots that
// are not empty; derivatives are per unit of a segment's t.
#include "sublimit/patches/knots.h"
#include "sublimit/patches/linear_curve.h"

namespace sublimit {

class SplineCurve : public LinearCurve {
 public:
  explicit SplineCurve(Knots<double> knots) : knots_(std::move(knots)) {}

  const Knots<double>& knots() const { return knots_; }
  Index num_segments() const override { return knots_.num_faces(); }
  Index num_points() const override { return knots_.num_points(); }

  /// The place of a parameter of the knots, and the parameter of a place: see Knots.
  CurveSample place(double t, KnotSide side = KnotSide::right) const override;
  double parameter(const CurveSample& place) const { return knots_.parameter({place.segment, place.t}); }

  double length(Index segment) const override { return knots_.length(segment); }

  /// Of the segment's side at knots.
  CurveStencil stencil(const CurveSample& sample, int order = 0) const override;

 private:
  Knots<double> knots_;
};

}  // namespace sublimit
