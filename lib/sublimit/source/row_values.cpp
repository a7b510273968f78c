// SPDX-License-Identifier: Apache-2.0
#include "sublimit/source/row_values.h"

#include <cmath>
#include <limits>
#include <span>

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

}  // namespace sublimit
