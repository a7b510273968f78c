// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places on a limit curve, and what is there.
#include <cstdint>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/limit/limit_status.h"

namespace sublimit {

/// A place: from a point (t = 0) of a curve to the next (t = 1). Segments are numbered through all curves.
struct CurveSample {
  Index segment = 0;
  double t = 0;
};

/// Limits row by row. Absent quantities are zero; `order` and `status` say what is there.
struct [[nodiscard]] CurveSamples {
  Points position;  ///< #samples x dimension
  Points first;     ///< order >= 1
  Points second;    ///< order 2
  /// Unit length. In the plane to the left of the first derivative (order >= 1); in space the principal normal, towards
  /// the centre of curvature (order 2). In other dimensions, and where there is none: zero.
  Points normal;
  std::vector<LimitStatus> status;
  std::vector<std::int8_t> order;  ///< derivatives that this row has: 0, 1 or 2

  /// Rows of zeros, for derivatives up to an order.
  CurveSamples(Eigen::Index rows, Eigen::Index dimension, int derivatives);
  /// Fills the normal of a row from its derivatives.
  /// @param noise  what a first derivative of length zero may have for rounding: then the status is `undefined_normal`
  void set_normal(Index row, double noise);
};

/// @param segments  how many there are
/// @param row  of a list of samples, for the message; -1: of none
/// @throws InvalidParameter  a segment that does not exist, t outside [0, 1] or not finite
void check_sample(const CurveSample& sample, Index segments, std::int64_t row = -1);

}  // namespace sublimit
