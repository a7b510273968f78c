// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places on limit curves, and the points, derivatives and normals that evaluation returns for them.
//
//   const LimitCurve curve(curve_scheme("chaikin"), polygon_through(points));
//   const CurveSamples samples = curve.evaluate(points, std::vector<CurvePlace>{{.segment = 0, .t = 0.5}}, 1);
//   samples.position.row(0), samples.first.row(0), samples.normal.row(0);
//   if (samples.status[0] == LimitStatus::outside) return;
#include <cstdint>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/source/limit_status.h"

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

}  // namespace sublimit
