// SPDX-License-Identifier: Apache-2.0
#pragma once
// The exact limit of curves anywhere: what limit_map.h is for surfaces.
//
//   x(i,t) = b T_m ... T_1 x_0      T_i: blocks of S on the path; b: basis of a polynomial piece, or a limit mask
//
// Every double t is a dyadic number, so the path ends, at a vertex of some level if not at a polynomial before: nothing
// is cut off. Pieces are computed once a type of neighbourhood (curve_pieces.h).
//
// Addresses. Segment i of a curve goes from its point i to point i + 1; an open curve of n points has n - 1 segments, a
// closed one n, the last from the last point to the first. Segments are numbered through all curves, in order.
// Derivatives are per leg of the curve, the natural parameter: t, but in dual schemes with kept ends, whose first and
// last segments are half a leg long (t = 1 is half a leg from t = 0, and derivatives by t are half of those given).
//
// With free ends a limit starts inside the polygon: places before its start get the start's position and the status
// `outside`, and so at the end.
#include <memory>
#include <span>
#include <vector>

#include "sublimit/curves/curve_refine.h"
#include "sublimit/curves/curve_sample.h"
#include "sublimit/geometric/geometric_scheme.h"
#include "sublimit/limit/limit_status.h"

namespace sublimit {

class CurvePieces;

/// Weights over the unknowns of one place.
///
/// Status: `regular`: position and two derivatives; `unbounded_second`: the second derivative is unbounded or not
/// continuous, and absent; `crease`: an end of an open curve, or a corner of the curve: derivatives are one-sided, at a
/// corner those of the segment that was given; `undefined_normal`: no derivative; `outside`: see above.
struct [[nodiscard]] CurveStencil {
  LimitStatus status = LimitStatus::regular;
  std::vector<Index> unknowns;  ///< ascending; points, in Hermite schemes 2i for point i and 2i + 1 for its derivative
  /// Rows: position, then the first and the second derivative as far as asked for and existing; one column per unknown.
  /// Position weights of points sum to 1, derivatives' to 0.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> weights;
};

class LimitCurve {
 public:
  /// Stencils over the points of the polygon.
  /// @throws InvalidMesh, UnsupportedTopology, ResourceError  as refinement does
  /// @throws AnalysisError  the scheme has no limit
  LimitCurve(const CurveScheme<double>& scheme, const ControlPolygon& polygon);
  /// Makes the curve from a level, with stencils over its points, and derivatives per segment of it.
  LimitCurve(const CurveScheme<double>& scheme, const CurveLevel& level);
  ~LimitCurve();
  LimitCurve(LimitCurve&&) noexcept;
  LimitCurve& operator=(LimitCurve&&) noexcept;

  Index num_segments() const;
  Index num_curves() const;
  /// First segment of a curve; those of its other points follow.
  Index first_segment(Index curve) const;
  /// Unknowns that stencils are over: rows of `unknowns(scheme, polygon)`.
  Index num_unknowns() const;
  /// The natural parameter of a place on its curve: i + t, and with kept ends in a dual scheme t/2, 1/2 + t, ...
  double parameter(const CurveSample& sample) const;

  /// Stencil of one place. Every request has an answer: what does not exist there is told by the status.
  /// @param order  of derivatives: 0, 1 or 2
  /// @throws InvalidParameter  a segment that does not exist, t outside [0, 1] or not finite, another order
  CurveStencil stencil(const CurveSample& sample, int order = 0) const;

  /// Points of the curve with derivatives and normals; in parallel.
  /// @param unknowns  #unknowns x dimension
  /// @throws InvalidParameter  as `stencil`, naming the row; an array of another length
  CurveSamples evaluate(const Points& unknowns, std::span<const CurveSample> samples, int order = 0) const;

  /// N samples of every segment at equal distances of t, both ends included.
  /// @throws InvalidParameter  fewer than 2
  std::vector<CurveSample> grid(int N) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Evaluates limits of schemes without a matrix. t is the parameter of the scheme's closed form on a segment:
/// for hermite-incentre every arc of a segment has the same share of it, and t is the fraction of length on the arc.
/// Derivatives are by length, so that they are the unit tangent and the vector of curvature: the limit is G^1.
/// @throws InvalidMesh, UnsupportedTopology  what the scheme cannot take
/// @throws InvalidParameter                  as LimitCurve
CurveSamples evaluate(const GeometricCurveScheme& scheme, const ControlPolygon& polygon,
                      std::span<const CurveSample> samples, int order = 0);

}  // namespace sublimit
