// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit curves: exact points, derivatives, normals and stencils anywhere on the limit of a polygon.
//
//   const Points points{{0, 0}, {1, 2}, {3, 2}, {4, 0}};
//   const LimitCurve curve(curve_scheme("lane-riesenfeld"), polygon_through(points));
//   const CurveSamples samples = curve.evaluate(points, curve.grid(9), 2);
//   const CurveStencil weights = curve.stencil({.segment = 1, .t = 0.25});
//
// A place on segment i is followed through the children of the points around it: x(i,t) = b T_m ... T_1 x_0, where T_j
// are blocks of S on the path, and b is the basis of a polynomial piece, or a limit mask. Every double t is a dyadic
// number, so the path ends at a vertex of some level, if not at a polynomial before: nothing is cut off. Pieces are
// computed once for each type of neighbourhood.
//
// Addresses. Segment i of a curve goes from its point i to point i + 1; an open curve of n points has n - 1 segments, a
// closed one n, the last from the last point to the first. Segments are numbered through all curves, in order.
// Derivatives are per edge of the curve, the natural parameter: t, but in dual schemes with kept ends, whose first and
// last segments are half an edge long (t = 1 is half an edge from t = 0, and derivatives by t are half of those given).
//
// With free ends a limit starts inside the polygon: places before its start get the start's position and the status
// `outside`, and so at the end.
#include <memory>
#include <span>
#include <vector>

#include "sublimit/curves/curve_refine.h"
#include "sublimit/curves/curve_source.h"

namespace sublimit {

template <class Data>
struct GeometricScheme;
using GeometricCurveScheme = GeometricScheme<ControlPolygon>;

class CurvePieces;

/// The limit of the curves of a polygon, without points. It never changes: threads may share it.
///
/// Stencils have weights over the rows of `unknowns(scheme, polygon)`. The status of a place does not depend on the
/// order that was asked for: `crease` is an end of an open curve or a corner.
class LimitCurve : public CurveSource {
 public:
  /// Makes the limit of a polygon, with stencils over its points.
  /// @throws InvalidMesh, UnsupportedTopology, ResourceError  as refinement does
  /// @throws AnalysisError  the scheme has no limit
  LimitCurve(const CurveScheme<double>& scheme, const ControlPolygon& polygon);
  /// Makes the curve from a level, with stencils over its points, and derivatives per segment of it.
  LimitCurve(const CurveScheme<double>& scheme, const CurveLevel& level);
  ~LimitCurve() override;
  LimitCurve(LimitCurve&&) noexcept;
  LimitCurve& operator=(LimitCurve&&) noexcept;

  Index num_segments() const override;
  Index num_points() const override;
  Index unknowns_per_point() const override;
  Index num_curves() const;
  /// Returns the first segment of a curve; its other segments follow.
  Index first_segment(Index curve) const;
  /// Returns the natural parameter of a place on its curve: i + t, and with kept ends in a dual scheme t/2, 1/2 + t,
  /// ...
  double parameter(const CurvePlace& place) const;

  CurveStencil stencil(const CurvePlace& place, int order = 0) const override;

  /// Returns the place of each point of the curves, in order along them; of points outside the limit of a curve with
  /// free ends the start or the end of it.
  std::vector<CurvePlace> point_places() const;

 protected:
  void fill_samples(std::span<const CurvePlace> places, const Points& columns, Coordinates coordinates, Index first,
                    CurveSamples& out) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Evaluates the limit of a scheme without a matrix. t is the parameter of the scheme's closed form on a segment:
/// for hermite-incentre every arc of a segment has the same share of it, and t is the fraction of length on the arc.
/// Derivatives are by arc length, so they are the unit tangent and the curvature vector: the limit is G^1.
/// @param order  number of derivatives: 0, 1 or 2
/// @throws InvalidMesh, UnsupportedTopology  a polygon that the scheme cannot take
/// @throws InvalidParameter                  a segment that does not exist, t outside [0, 1], another order
CurveSamples evaluate(const GeometricCurveScheme& scheme, const ControlPolygon& polygon,
                      std::span<const CurvePlace> places, int order = 0);

}  // namespace sublimit
