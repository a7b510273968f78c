// SPDX-License-Identifier: Apache-2.0
#pragma once
// Interface of curves that are linear in their control points: limits of schemes (LimitCurve), classical curves
// (SplineCurve, CurveSet), as LinearSource is for surfaces. A kind of curve defines its stencils; grids, points with
// derivatives and normals, matrices and rational curves are here.
//
//   const LimitCurve limit(curve_scheme("chaikin"), polygon_through(points));
//   const CurveSource& curve = limit;
//   const CurveSamples samples = curve.evaluate(points, curve.grid(9), 2);
//   const CurveStencil stencil = curve.stencil({.segment = 1, .t = 0.25});
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/source/limit_status.h"
#include "sublimit/source/place_stencils.h"
#include "sublimit/source/rational.h"

namespace sublimit {

/// A place on a curve: a segment, and the parameter in it.
struct CurvePlace {
  Index segment = 0;  ///< number of the segment, counted through all curves
  double t = 0;       ///< 0 at the point where the segment starts, 1 at the next one

  bool operator==(const CurvePlace&) const = default;
};

/// Points of curves, a row for each place. Absent quantities are zero; `order` and `status` say what is present. Plain
/// data.
struct [[nodiscard]] CurveSamples {
  Points position;  ///< #places x dimension
  Points first;     ///< first derivatives, if order >= 1
  Points second;    ///< second derivatives, if order is 2
  /// Unit normals. In the plane to the left of the first derivative (order >= 1); in space the principal normal,
  /// towards the centre of curvature (order 2). Zero in other dimensions and where undefined.
  Points normal;
  std::vector<LimitStatus> status;
  std::vector<std::int8_t> order;  ///< derivatives that each row has: 0, 1 or 2

  /// Makes rows of zeros, for derivatives up to an order.
  CurveSamples(Eigen::Index rows, Eigen::Index dimension, int derivatives);
  /// Returns the number of derivatives that there are rows for; without any rows 0.
  int derivatives() const { return int{first.rows() > 0} + int{second.rows() > 0}; }
  /// Returns the positions (0), the first (1) or the second derivatives (2).
  Points& part(int derivative) { return derivative == 0 ? position : derivative == 1 ? first : second; }
  const Points& part(int derivative) const { return const_cast<CurveSamples&>(*this).part(derivative); }
  /// Fills the normal of a row from its derivatives.
  /// @param noise  a first derivative of at most this length counts as zero: the status becomes `undefined_normal`
  void set_normal(Index row, double noise);
};

/// Throws unless a place is on one of `segments` segments.
/// @param row  number of the place in a list, for the message; -1: none
/// @throws InvalidParameter  a segment that does not exist, t outside [0, 1] or not finite
void check_place(const CurvePlace& place, Index segments, std::int64_t row = -1);

/// The stencil of a place: weights over the unknowns of a curve. Plain data.
///
/// Status: `regular`: position and all derivatives that were asked for; `unbounded_second`: the second derivative is
/// unbounded or not continuous, and absent; `crease`: derivatives are one-sided: at an end of an open limit curve, and
/// where rows that were asked for differ on the other side, those of the segment that was given; `undefined_normal`: no
/// derivative; `outside`: before the start or after the end of a limit curve with free ends.
struct [[nodiscard]] CurveStencil {
  LimitStatus status = LimitStatus::regular;
  std::vector<Index> unknowns;  ///< ascending; points, in Hermite schemes 2i for point i and 2i + 1 for its derivative
  /// Rows: position, then the first and the second derivative as far as asked for and existing; one column per unknown.
  /// Position weights of points sum to 1, derivatives' to 0.
  WeightRows weights;
};

/// One curve or several, without control points. It never changes: threads may share it.
class CurveSource {
 public:
  virtual ~CurveSource() = default;

  /// Returns the number of segments of all curves.
  virtual Index num_segments() const = 0;
  /// Returns the number of control points.
  virtual Index num_points() const = 0;
  /// Returns the number of unknowns at every point: 1, or 2 (point and derivative) for a Hermite scheme.
  virtual Index unknowns_per_point() const { return 1; }
  /// Returns the number of unknowns that stencils have weights for.
  Index num_unknowns() const { return num_points() * unknowns_per_point(); }

  /// Returns the stencil of a place. The status says which derivatives do not exist there.
  /// @param order  number of derivatives: 0, 1 or 2
  /// @throws InvalidParameter  a segment that does not exist, t outside [0, 1] or not finite, another order
  virtual CurveStencil stencil(const CurvePlace& place, int order = 0) const = 0;

  /// Returns points of the curve with derivatives and normals; in parallel. A place where w = 0 has the status `pole`
  /// and nothing else.
  /// @param columns  #unknowns x dimension, and one column more if they are homogeneous
  /// @param order    number of derivatives: 0, 1 or 2
  /// @throws InvalidParameter  a place as in `stencil`: names its row; an array of another size
  CurveSamples evaluate(const Points& columns, std::span<const CurvePlace> places, int order = 0,
                        Coordinates coordinates = Coordinates::plain) const;

  /// Returns N places on every segment at equal distances of t, both ends included.
  /// @throws InvalidParameter  fewer than 2
  std::vector<CurvePlace> grid(int N) const;

 protected:
  CurveSource() = default;
  CurveSource(const CurveSource&) = default;
  CurveSource(CurveSource&&) = default;
  CurveSource& operator=(const CurveSource&) = default;
  CurveSource& operator=(CurveSource&&) = default;

  /// Fills rows of `out`, which are zero, by the stencils of places that exist. A kind of curve that has its rows
  /// without stencils overrides it.
  /// @param first  row of the first place; those of the others follow
  virtual void fill_samples(std::span<const CurvePlace> places, const Points& columns, Coordinates coordinates,
                            Index first, CurveSamples& out) const;
};

/// Returns the stencils of places of a curve: matrices over the unknowns for the position and for each derivative.
/// @param derivatives  0, 1 or 2
/// @throws InvalidParameter  a place as in `CurveSource::stencil`, another number of derivatives
/// @throws ResourceError     more weights than 32-bit indices count
PlaceStencils place_stencils(const CurveSource& curve, std::span<const CurvePlace> places, int derivatives = 0);

}  // namespace sublimit
