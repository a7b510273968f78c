// SPDX-License-Identifier: Apache-2.0
#pragma once
// Classical curves as linear sources: what patches are for surfaces, and LimitCurve for schemes. A kind of curve says
// what its rows are; samples with normals and poles follow here.
#include <span>

#include "sublimit/curves/limit_curve.h"
#include "sublimit/patches/knots.h"
#include "sublimit/patches/rational.h"

namespace sublimit {

/// One curve or several.
class CurveSource {
 public:
  virtual ~CurveSource() = default;

  virtual Index num_segments() const = 0;
  virtual Index num_points() const = 0;

  /// Rows over the control points, of the segment's side where sides differ: position, then derivatives per unit of the
  /// segment's t. Status: `crease` where the other side has other rows, of those asked for, else `regular`.
  /// @throws InvalidParameter  a segment that does not exist, t outside [0, 1] or not finite, another order than 0 to 2
  virtual CurveStencil stencil(const CurveSample& sample, int order = 0) const = 0;

  /// Points with derivatives and normals; in parallel. A place where w = 0 has the status `pole` and nothing else.
  /// @param columns  #points x dimension, and one more if they are homogeneous
  /// @throws InvalidParameter  as `stencil`, naming the row; an array of another size
  CurveSamples evaluate(const Points& columns, std::span<const CurveSample> samples, int order = 0,
                        Coordinates coordinates = Coordinates::plain) const;

 protected:
  CurveSource() = default;
  CurveSource(const CurveSource&) = default;
  CurveSource(CurveSource&&) = default;
  CurveSource& operator=(const CurveSource&) = default;
  CurveSource& operator=(CurveSource&&) = default;
};

/// One curve, with a parameter of its own: the second way to name a place.
class LinearCurve : public CurveSource {
 public:
  /// At a knot the side says whose piece is meant.
  /// @throws InvalidParameter  outside the domain, naming it
  virtual CurveSample place(double t, KnotSide side = KnotSide::right) const = 0;
  /// How long a segment is in this parameter: derivatives per unit of it are those of the segment divided by that.
  virtual double length(Index segment) const = 0;
};

}  // namespace sublimit
