// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_lu.h"
#include "sublimit/core/detail/sparse_rows.h"
#include "sublimit/patches/detail/spline_rows.h"

namespace sublimit {
namespace {

std::string numbered(const char* what, size_t i, double value) {
  return std::string(what) + " " + format_number(i) + " is " + format_number(value);
}

void check_rising(std::span<const double> parameters) {
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (!std::isfinite(parameters[i]))
      throw InvalidParameter(numbered("parameter", i, parameters[i]) + ": parameters must be finite numbers");
    if (i > 0 && parameters[i] == parameters[i - 1])
      throw InvalidParameter("parameters " + format_number(i - 1) + " and " + format_number(i) + " are both " +
                             format_number(parameters[i]) + ": parameters must rise");
    if (i > 0 && parameters[i] < parameters[i - 1])
      throw InvalidParameter(numbered("parameter", i, parameters[i]) + ", less than the one before, " +
                             format_number(parameters[i - 1]) + ": parameters must rise");
  }
}

/// N_i(tau_i) > 0, by the knots alone: inside the support, or at an end of it where the function is 1.
void check_schoenberg_whitney(const Knots<double>& knots, std::span<const double> parameters) {
  const int p = knots.degree();
  const std::span<const double> t = knots.all();
  for (size_t i = 0; i < parameters.size(); ++i) {
    const double tau = parameters[i];
    const bool inside = t[i] < tau && tau < t[i + p + 1];
    const bool at_start = tau == t[i] && t[i] == t[i + p], at_end = tau == t[i + p + 1] && t[i + 1] == t[i + p + 1];
    if (!inside && !at_start && !at_end)
      throw InvalidParameter(numbered("parameter", i, tau) + ": it must lie between knots " + format_number(i) +
                             " and " + format_number(i + p + 1) + ", which are " + format_number(t[i]) + " and " +
                             format_number(t[i + p + 1]) + ", for a spline through any points to exist");
  }
}

}  // namespace

SparseMatrix condition_rows(const Knots<double>& knots, std::span<const SplineCondition> conditions) {
  SparseRows rows;
  for (const auto& [t, order] : conditions) {
    const KnotPlace<double> place = knots.place(t);
    const PointRows at = point_rows(knots, place, order);
    const double unit = std::pow(knots.length(place.face), order);
    for (size_t i = 0; i < at.points.size(); ++i)
      if (const double weight = at.weights(order, Eigen::Index(i)); weight != 0) rows.add(at.points[i], weight / unit);
    rows.end_row();
  }
  std::vector<SparseRows::Row> spans;
  for (size_t i = 0; i < rows.size(); ++i) spans.push_back(rows[i]);
  return matrix_of(spans, knots.num_points());
}

Points solve_conditions(const Knots<double>& knots, std::span<const SplineCondition> conditions, const Points& values) {
  if (std::ssize(conditions) != knots.num_points() || values.rows() != std::ssize(conditions))
    throw InvalidParameter(format_number(values.rows()) + " values for " + format_number(conditions.size()) +
                           " conditions on " + format_number(knots.num_points()) +
                           " control points: one is needed for each");
  if (!values.allFinite()) throw InvalidParameter("points to be interpolated must be finite numbers");
  const SparseMatrix rows = condition_rows(knots, conditions);
  const ColumnMatrix M = rows;
  const SparseLu factors(M);
  const auto refuse = [] {
    throw InvalidParameter("the conditions on the spline depend on each other: other parameters are needed");
  };
  if (!factors.has_factors()) refuse();
  const Eigen::MatrixXd right = values;
  Eigen::MatrixXd solution = factors.solve(right);
  if (!solution.allFinite()) refuse();
  solution += factors.solve(Eigen::MatrixXd(right - M * solution));
  return solution;
}

Knots<double> averaged_knots(int degree, std::span<const double> parameters) {
  if (parameters.empty())
    throw InvalidParameter("no parameters: " + format_number(degree + 1) + " at least are needed");
  return averaged_knots(degree, parameters, parameters.front(), parameters.back());
}

Knots<double> averaged_knots(int degree, std::span<const double> parameters, double begin, double end) {
  check_degree(degree);
  check_rising(parameters);
  if (std::ssize(parameters) <= degree)
    throw InvalidParameter(format_number(parameters.size()) + " parameters for degree " + format_number(degree) + ": " +
                           format_number(degree + 1) + " at least are needed");
  const auto n = static_cast<Index>(parameters.size());
  std::vector<double> knots(static_cast<size_t>(degree) + 1, begin);
  for (Index j = 1; j + degree < n; ++j) {
    double sum = 0;
    // Degree 0: the steps are between parameters.
    const Index first = degree == 0 ? j - 1 : j, count = degree == 0 ? 2 : degree;
    for (Index i = first; i < first + count; ++i) sum += parameters[static_cast<size_t>(i)] / count;
    knots.push_back(sum);
  }
  knots.insert(knots.end(), static_cast<size_t>(degree) + 1, end);
  return Knots<double>::open(degree, n, std::move(knots));
}

Points interpolating_points(const Knots<double>& knots, std::span<const double> parameters, const Points& values) {
  if (knots.is_closed()) throw InvalidParameter("closed knots: splines through points at given parameters are open");
  check_rising(parameters);
  if (std::ssize(parameters) != knots.num_points() || values.rows() != knots.num_points())
    throw InvalidParameter(format_number(values.rows()) + " points at " + format_number(parameters.size()) +
                           " parameters for " + format_number(knots.num_points()) +
                           " control points: one is needed for each");
  check_schoenberg_whitney(knots, parameters);
  std::vector<SplineCondition> conditions;
  for (const double t : parameters) conditions.push_back({t, 0});
  return solve_conditions(knots, conditions, values);
}

CurveNet interpolating_cubic(CubicEnds ends, std::span<const double> parameters, const Points& points,
                             const Points& end_derivatives) {
  check_rising(parameters);
  const auto n = static_cast<Index>(parameters.size());
  if (n < 2) throw InvalidParameter(format_number(n) + " parameters: a cubic spline needs 2 at least");
  const bool left_out = ends == CubicEnds::periodic && points.rows() == n - 1;
  if (points.rows() != n && !left_out)
    throw InvalidParameter(format_number(points.rows()) + " points at " + format_number(n) +
                           " parameters: one is needed for each");
  const Index derivatives = ends == CubicEnds::clamped ? 2 : 0;
  if (end_derivatives.rows() != derivatives || (derivatives > 0 && end_derivatives.cols() != points.cols()))
    throw InvalidParameter(format_number(end_derivatives.rows()) + " end derivatives: ends that are " +
                           cubic_ends_words[static_cast<int>(ends)] + " need " + format_number(derivatives));
  std::vector<SplineCondition> conditions;
  for (const double t : parameters) conditions.push_back({t, 0});
  if (ends == CubicEnds::periodic) {
    const Eigen::RowVectorXd gap =
        left_out ? Eigen::RowVectorXd::Zero(points.cols()) : Eigen::RowVectorXd(points.row(n - 1) - points.row(0));
    if (!(gap.norm() <= 64 * std::numeric_limits<double>::epsilon() * points.cwiseAbs().maxCoeff()))
      throw InvalidMesh("a periodic curve whose last point is " + format_number(gap.norm()) +
                        " from its first: they must be the same, or the last left out");
    conditions.pop_back();
    Knots<double> knots = Knots<double>::closed(3, {parameters.begin(), parameters.end()});
    Points control = solve_conditions(knots, conditions, points.topRows(n - 1));
    return {std::move(knots), std::move(control)};
  }
  std::vector<double> all(3, parameters.front());
  all.insert(all.end(), parameters.begin(), parameters.end());
  all.insert(all.end(), 3, parameters.back());
  Knots<double> knots = Knots<double>::open(3, n + 2, std::move(all));
  const int order = ends == CubicEnds::clamped ? 1 : 2;
  conditions.push_back({parameters.front(), order});
  conditions.push_back({parameters.back(), order});
  Points values = Points::Zero(n + 2, points.cols());
  values.topRows(n) = points;
  if (derivatives > 0) values.bottomRows(2) = end_derivatives;
  Points control = solve_conditions(knots, conditions, values);
  return {std::move(knots), std::move(control)};
}

}  // namespace sublimit
