// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/finite_points.h"

#include <limits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

template <class Refusal>
void check(const Points& points, const std::string& what, double largest) {
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if ((points.row(i).array().abs() <= largest).all()) continue;  // false for NaN
    std::string text = what + " " + std::to_string(i) + " is ";
    for (Eigen::Index c = 0; c < points.cols(); ++c) text += (c == 0 ? "(" : ", ") + format_number(points(i, c));
    throw Refusal(text + (points.row(i).allFinite()
                              ? "), with a coordinate above 1e150 in size, whose square is no number; give it "
                                "in another unit of length"
                              : "), which is not finite; coordinates are numbers"));
  }
}

}  // namespace

void check_measurable(const Points& points, const std::string& what) {
  check<InvalidParameter>(points, what, farthest_coordinate);
}

void check_in_space(const Points& points) {
  if (points.rows() > 0 && points.cols() != 3)
    throw InvalidMesh("control points have " + std::to_string(points.cols()) + " coordinates; 3 are right");
}

void check_finite_control(const Points& points) {
  check<InvalidMesh>(points, "control point", std::numeric_limits<double>::max());
}

void check_measurable_control(const Points& points) {
  check<InvalidMesh>(points, "control point", farthest_coordinate);
}

}  // namespace sublimit
