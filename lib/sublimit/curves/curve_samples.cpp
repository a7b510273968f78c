// SPDX-License-Identifier: Apache-2.0
#include "sublimit/curves/curve_source.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {

CurveSamples::CurveSamples(Eigen::Index rows, Eigen::Index dimension, int derivatives)
    : position(Points::Zero(rows, dimension)),
      first(Points::Zero(derivatives >= 1 ? rows : 0, dimension)),
      second(Points::Zero(derivatives >= 2 ? rows : 0, dimension)),
      normal(Points::Zero(derivatives >= 1 ? rows : 0, dimension)),
      status(static_cast<size_t>(rows), LimitStatus::regular),
      order(static_cast<size_t>(rows), 0) {}

void CurveSamples::set_normal(Index row, double noise) {
  if (order[row] < 1) return;
  const double speed = first.row(row).stableNorm();
  if (!(speed > noise)) {
    status[row] = LimitStatus::undefined_normal;
    return;
  }
  if (first.cols() == 2) normal.row(row) << -first(row, 1) / speed, first(row, 0) / speed;
  if (first.cols() != 3 || order[row] < 2) return;
  const Eigen::RowVector3d along = first.row(row) / speed, bend = second.row(row);
  const Eigen::RowVector3d across = bend - bend.dot(along) * along;
  const double length = across.stableNorm();
  if (length > 16 * std::numeric_limits<double>::epsilon() * bend.stableNorm()) normal.row(row) = across / length;
}

void check_place(const CurvePlace& place, Index segments, std::int64_t row) {
  const std::string where = row < 0 ? "" : "sample " + format_number(row) + ": ";
  if (place.segment < 0 || place.segment >= segments)
    throw InvalidParameter(where + "segment " + format_number(place.segment) +
                           " does not exist; there are segments 0 to " + format_number(segments - 1));
  if (!(place.t >= 0 && place.t <= 1))
    throw InvalidParameter(where + "t is " + format_number(place.t) + "; it must be a number from 0 to 1");
}

}  // namespace sublimit
