// SPDX-License-Identifier: Apache-2.0
#pragma once
// A B-spline curve as a linear source: what LimitCurve is for curve schemes. Segments are the spans of its knots that
// are not empty; derivatives are per unit of a segment's t.
#include <span>

#include "sublimit/curves/limit_curve.h"
#include "sublimit/patches/knots.h"
#include "sublimit/patches/rational.h"

namespace sublimit {

class SplineCurve {
 public:
  explicit SplineCurve(Knots<double> knots) : knots_(std::move(knots)) {}

  const Knots<double>& knots() const { return knots_; }
  Index num_segments() const { return knots_.num_faces(); }
  Index num_points() const { return knots_.num_points(); }

  /// The place of a parameter of the knots, and the parameter of a place: see Knots.
  CurveSample place(double t, KnotSide side = KnotSide::right) const;
  double parameter(const CurveSample& place) const { return knots_.parameter({place.segment, place.t}); }

  /// Rows over the control points, of the segment's side at knots. Status: `crease` where the other side has other
  /// rows, of those asked for, else `regular`.
  /// @throws InvalidParameter  a segment that does not exist, t outside [0, 1] or not finite, another order than 0 to 2
  CurveStencil stencil(const CurveSample& sample, int order = 0) const;

  /// Points with derivatives and normals; in parallel. A place where w = 0 has the status `pole` and nothing else.
  /// @param columns  #points x dimension, and one more if they are homogeneous
  /// @throws InvalidParameter  as `stencil`, naming the row; an array of another size
  CurveSamples evaluate(const Points& columns, std::span<const CurveSample> samples, int order = 0,
                        Coordinates coordinates = Coordinates::plain) const;

 private:
  Knots<double> knots_;
};

}  // namespace sublimit
