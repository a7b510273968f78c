// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/rational.h"

#include <cmath>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {

Points homogeneous(const Points& points, const Eigen::VectorXd& weights) {
  if (weights.size() != points.rows())
    throw InvalidParameter(format_number(weights.size()) + " weights for " + format_number(points.rows()) +
                           " control points");
  Points columns(points.rows(), points.cols() + 1);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double w = weights[i];
    if (!std::isfinite(w))
      throw InvalidParameter("weight " + format_number(i) + " is " + format_number(w) + ": weights must be finite");
    columns.row(i) << (w == 0 ? 1 : w) * points.row(i), w;
    if (points.row(i).allFinite() && !columns.row(i).allFinite())
      throw InvalidParameter("control point " + format_number(i) + " times its weight " + format_number(w) +
                             " is too large for a number; another unit of length is right");
  }
  if (weights.isZero(0)) throw InvalidParameter("all weights are 0: one of them at least must not be");
  return columns;
}

Index num_weights_not_positive(const Points& homogeneous) {
  return static_cast<Index>((homogeneous.rightCols(1).array() <= 0).count());
}

Points points_in_space(const Points& columns) {
  if (columns.cols() != 4) return columns;
  Points points(columns.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < columns.rows(); ++i)
    if (columns(i, 3) != 0) points.row(count++) = columns.row(i).head(3) / columns(i, 3);
  points.conservativeResize(count, 3);
  return points;
}

void check_columns(const Points& columns, Index num_points, Coordinates coordinates) {
  const Index width = coordinates == Coordinates::homogeneous ? 4 : 3;
  if (columns.rows() != num_points || columns.cols() != width)
    throw InvalidParameter("columns are " + format_number(columns.rows()) + " x " + format_number(columns.cols()) +
                           ", not " + format_number(num_points) + " x " + format_number(width));
}

}  // namespace sublimit
