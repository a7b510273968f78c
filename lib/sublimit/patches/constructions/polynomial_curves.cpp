// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/polynomial_curves.h"

#include <cmath>
#include <limits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/constructions/power_coefficients.h"

namespace sublimit {
namespace {

Knots<double> knots_over(Eigen::Index points, double begin, double end) {
  if (points < 1) throw InvalidParameter("no control points: a curve needs one at least");
  const auto order = static_cast<size_t>(points);
  check_degree(static_cast<int>(std::min<size_t>(order - 1, max_degree + 1)));
  std::vector<double> knots(order, begin);
  knots.insert(knots.end(), order, end);
  return Knots<double>::open(static_cast<int>(order) - 1, static_cast<Index>(order), std::move(knots));
}

/// Bezier points from coefficients: row i has the blossoms of the powers at 0 (n-i times), 1 (i times).
Eigen::MatrixXd powers_to_bezier(int degree) {
  return polynomial_points(bezier_knots<double>(degree), Eigen::MatrixXd::Identity(degree + 1, degree + 1));
}

}  // namespace

CurveNet bezier_curve(Points points, double begin, double end, Coordinates coordinates) {
  Knots<double> knots = knots_over(points.rows(), begin, end);
  return {std::move(knots), std::move(points), coordinates};
}

CurveNet taylor_curve(const Points& coefficients, double begin, double end) {
  Knots<double> knots = knots_over(coefficients.rows(), begin, end);
  const Eigen::Index order = coefficients.rows();
  Points points = polynomial_points(knots, Eigen::MatrixXd::Identity(order, order)) * coefficients;
  return {std::move(knots), std::move(points)};
}

CurveNet hermite_curve(const Points& points, const Points& tangents) {
  if (points.rows() != 2 || tangents.rows() != 2 || points.cols() != tangents.cols())
    throw InvalidParameter("a Hermite curve: 2 points and 2 tangents of the same dimension are needed");
  Points data(4, points.cols());
  data << points, tangents;
  return {bezier_knots<double>(3), hermite_to_bezier() * data};
}

CurveNet matrix_curve(const MatrixCurve& curve) {
  const Eigen::Index order = curve.matrix.rows(), count = curve.points.rows();
  if (order < 2 || order > max_degree + 1 || curve.matrix.cols() != order)
    throw InvalidParameter("a basis matrix of " + format_number(order) + " x " + format_number(curve.matrix.cols()) +
                           ": (degree + 1) x (degree + 1) is needed, degree 1 to " + format_number(max_degree));
  if (curve.step < 1) throw InvalidParameter("step " + format_number(curve.step) + ": it must be 1 or more");
  if (count < order || (count - order) % curve.step != 0) {
    const Eigen::Index below = count < order ? order : count - (count - order) % curve.step;
    throw InvalidParameter(
        format_number(count) + " points in steps of " + format_number(curve.step) + " for degree " +
        format_number(order - 1) + ": " + format_number(below) +
        (count < order ? " at least are needed" : " or " + format_number(below + curve.step) + " are needed"));
  }
  const auto segments = static_cast<Index>((count - order) / curve.step + 1);
  std::vector<double> ends = curve.ends;
  if (ends.empty())
    for (Index s = 0; s <= segments; ++s) ends.push_back(s);
  if (std::ssize(ends) != segments + 1)
    throw InvalidParameter(format_number(ends.size()) + " ends of " + format_number(segments) +
                           " segments: " + format_number(segments + 1) + " are needed");
  for (size_t s = 1; s < ends.size(); ++s)
    if (!(ends[s - 1] < ends[s]))
      throw InvalidParameter("end " + format_number(s) + " of segments is " + format_number(ends[s]) +
                             ", not more than the one before, " + format_number(ends[s - 1]) + ": they must rise");
  const Eigen::MatrixXd to_bezier = powers_to_bezier(static_cast<int>(order) - 1) * curve.matrix.transpose();
  const double noise = 64 * std::numeric_limits<double>::epsilon() *
                       (to_bezier.cwiseAbs().rowwise().sum().maxCoeff() * curve.points.cwiseAbs().maxCoeff());
  std::vector<double> knots(static_cast<size_t>(order), ends.front());
  Points control(segments * order, curve.points.cols());
  Eigen::Index size = 0;
  for (Index s = 0; s < segments; ++s) {
    const Points piece = to_bezier * curve.points.middleRows(s * curve.step, order);
    Eigen::Index from = 0;
    if (s > 0) {
      const bool joined = (piece.row(0) - control.row(size - 1)).cwiseAbs().maxCoeff() <= noise;
      from = joined ? 1 : 0;
      knots.insert(knots.end(), static_cast<size_t>(order - from), ends[size_t(s)]);
    }
    control.middleRows(size, order - from) = piece.bottomRows(order - from);
    size += order - from;
  }
  knots.insert(knots.end(), static_cast<size_t>(order), ends.back());
  return {Knots<double>::open(static_cast<int>(order) - 1, static_cast<Index>(size), std::move(knots)),
          control.topRows(size)};
}

}  // namespace sublimit
