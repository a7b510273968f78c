// SPDX-License-Identifier: Apache-2.0
#include "sublimit/source/rational.h"

#include <cmath>
#include <limits>
#include <span>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

/// A term of the quotient rule for row r: factor * w_row x_lower, of row r of A = w x.
struct Term {
  int row, lower, factor;
};
/// Terms of the derivatives of A but w x_r: (w x)_uu = w x_uu + 2 w_u x_u + w_uu x, and so on.
std::span<const Term> terms(int variables, Eigen::Index row) {
  static constexpr Term none[] = {{0, 0, 0}};
  static constexpr Term first[] = {{1, 0, 1}}, second[] = {{1, 1, 2}, {2, 0, 1}};
  static constexpr Term v[] = {{2, 0, 1}};
  static constexpr Term uu[] = {{1, 1, 2}, {3, 0, 1}}, uv[] = {{1, 2, 1}, {2, 1, 1}, {4, 0, 1}},
                        vv[] = {{2, 2, 2}, {5, 0, 1}};
  static constexpr std::span<const Term> curve[] = {none, first, second}, surface[] = {none, first, v, uu, uv, vv};
  return variables == 1 ? curve[row] : surface[row];
}

}  // namespace

RowValues row_values(const WeightRows& rows, int variables, Points columns, Coordinates coordinates, bool affine) {
  RowValues result;
  const bool rational = coordinates == Coordinates::homogeneous;
  const Eigen::Index dimension = columns.cols() - (rational ? 1 : 0);
  const Eigen::VectorXd weights =
      rational ? Eigen::VectorXd(columns.col(dimension)) : Eigen::VectorXd::Ones(columns.rows());
  Eigen::VectorXd w = Eigen::VectorXd::Zero(rows.rows()), w_sizes = w;
  w[0] = 1;  // rows of points sum to it, those of derivatives to 0: better than their rounding
  if (rational) {
    w = rows * weights;
    w_sizes = rows.cwiseAbs() * weights.cwiseAbs();
    if (!(std::abs(w[0]) > 4 * std::numeric_limits<double>::epsilon() * w_sizes[0])) {
      result.is_pole = true;
      return result;
    }
  }
  // Seen from the control point that counts most: derivatives do not lose digits to where the surface lies, and vanish
  // exactly where control points coincide.
  Eigen::Index nearest = 0;
  (rows.row(0).transpose().cwiseProduct(weights)).cwiseAbs().maxCoeff(&nearest);
  Eigen::RowVectorXd origin = Eigen::RowVectorXd::Zero(dimension);
  if (rational || affine) origin = columns.row(nearest).head(dimension) / weights[nearest];
  columns.leftCols(dimension) -= weights * origin;
  const Points A = rows * columns.leftCols(dimension);
  result.values.resize(rows.rows(), dimension);
  result.sizes = rows.cwiseAbs() * columns.leftCols(dimension).rowwise().norm();
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    Eigen::RowVectorXd value = A.row(r);
    double size = result.sizes[r];
    if (rational && r > 0)
      for (const Term& term : terms(variables, r)) {
        value -= (term.factor * w[term.row]) * result.values.row(term.lower);
        size += term.factor * w_sizes[term.row] * result.values.row(term.lower).norm();
      }
    result.values.row(r) = value / w[0];
    result.sizes[r] = size / std::abs(w[0]);
  }
  result.values.row(0) += origin;
  return result;
}

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
