// SPDX-License-Identifier: Apache-2.0
#include "sublimit/nets/piece_hull.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/nets/triangle_blossom.h"

#include "sublimit/core/detail/binomial.h"

namespace sublimit {
namespace {

/// Bernstein polynomials at a place, in the order of the basis.
Eigen::RowVectorXd bernstein(int d, bool total, double u, double v) {
  Eigen::RowVectorXd row(total ? (d + 1) * (d + 2) / 2 : (d + 1) * (d + 1));
  int column = 0;
  for (int k = 0; k <= d; ++k)
    for (int l = 0; l <= (total ? d - k : d); ++l, ++column)
      row[column] = total ? double(binomial(d, k) * binomial(d - k, l)) * std::pow(u, k) * std::pow(v, l) *
                                std::pow(1 - u - v, d - k - l)
                          : double(binomial(d, k) * binomial(d, l)) * std::pow(u, k) * std::pow(1 - u, d - k) *
                                std::pow(v, l) * std::pow(1 - v, d - l);
  return row;
}

/// Calls node(row, u, v) at the nodes of the net.
template <class Node>
void for_each_node(const PolynomialBasis& basis, const Node& node) {
  const int d = basis.degree();
  int row = 0;
  for (int i = 0; i <= d; ++i)
    for (int j = 0; j <= (basis.total() ? d - i : d); ++j, ++row) node(row, double(i) / d, double(j) / d);
}

/// Bernstein polynomials, by columns, at the nodes.
Eigen::MatrixXd nodes_of(const PolynomialBasis& basis) {
  Eigen::MatrixXd values(basis.size(), basis.size());
  for_each_node(basis,
                [&](int row, double u, double v) { values.row(row) = bernstein(basis.degree(), basis.total(), u, v); });
  return values;
}

/// Of one direction, by de Casteljau's steps: the control points of [0, 1/2], or of [1/2, 1].
Eigen::MatrixXd half_matrix(int d, bool upper) {
  Eigen::MatrixXd half = Eigen::MatrixXd::Zero(d + 1, d + 1);
  for (int i = 0; i <= d; ++i)
    for (int l = 0; l <= i; ++l) half(upper ? d - i : i, upper ? d - l : l) = std::ldexp(binomial(i, l), -i);
  return half;
}

Eigen::MatrixXd square_quarter(int d, int k) {
  const Eigen::MatrixXd in_u = half_matrix(d, (k & 1) != 0), in_v = half_matrix(d, (k >> 1) != 0);
  const Eigen::Index side = d + 1;
  Eigen::MatrixXd quarter(side * side, side * side);
  for (Eigen::Index i = 0; i < side; ++i)
    for (Eigen::Index l = 0; l < side; ++l) quarter.block(i * side, l * side, side, side) = in_u(i, l) * in_v;
  return quarter;
}

/// Control points are values of the blossom at the quarter's corners.
Eigen::MatrixXd triangle_quarter(int d, int k) {
  std::array<Barycentric, 3> corners;
  for (size_t c = 0; c < 3; ++c) {
    const double own_u = c == 1 ? 1 : 0, own_v = c == 2 ? 1 : 0;
    const bool turned = k == 3;
    const double u = turned ? (1 - own_u) / 2 : (own_u + (k & 1)) / 2;
    const double v = turned ? (1 - own_v) / 2 : (own_v + (k >> 1)) / 2;
    corners[c] = {1 - u - v, v, u};  // rows of nets go by u, then by v, which is the blossom's faster one
  }
  const Eigen::Index size = (d + 1) * (d + 2) / 2;
  Eigen::MatrixXd quarter(size, size);
  std::vector<Barycentric> arguments;
  Eigen::Index row = 0;
  for (int i = 0; i <= d; ++i)
    for (int j = 0; j <= d - i; ++j, ++row) {
      arguments.assign(size_t(d - i - j), corners[0]);
      arguments.insert(arguments.end(), size_t(i), corners[1]);
      arguments.insert(arguments.end(), size_t(j), corners[2]);
      const std::vector<double> weights = triangle_blossom(arguments);
      quarter.row(row) = Eigen::Map<const Eigen::RowVectorXd>(weights.data(), size);
    }
  return quarter;
}

}  // namespace

Eigen::Vector2d BernsteinQuarters::in_quarter(int k, bool triangle, double u, double v) {
  if (triangle && k == 3) return {1 - 2 * u, 1 - 2 * v};  // the middle one lies upside down
  return {2 * u - (k & 1), 2 * v - (k >> 1)};
}

Eigen::MatrixXd bernstein_from(const PolynomialBasis& basis) {
  Eigen::MatrixXd ours(basis.size(), basis.size());
  for_each_node(basis, [&](int row, double u, double v) { ours.row(row) = basis.at(u, v, 0); });
  return PivotedLu(nodes_of(basis)).solve(ours);
}

BernsteinQuarters::BernsteinQuarters(int degree, bool total) {
  for (int k = 0; k < 4; ++k) quarters_[size_t(k)] = total ? triangle_quarter(degree, k) : square_quarter(degree, k);
}

std::vector<Points> polynomial_nets(const PiecePolynomial& polynomial, const Eigen::MatrixXd& from_basis,
                                    const Points& points) {
  const Points differences = points.bottomRows(points.rows() - 1).rowwise() - points.row(0);
  std::vector<Points> nets;
  for (const RowMatrix& C : polynomial.coefficients)
    nets.push_back((from_basis * (C * differences)).rowwise() + points.row(0));
  return nets;
}

Points child_points(const PieceLink& link, const Points& points) {
  const Points differences = points.bottomRows(points.rows() - 1).rowwise() - points.row(0);
  Points child(link.block.child_slots(), points.cols());
  child.row(0) = points.row(0) + link.block.origin() * differences;
  child.bottomRows(child.rows() - 1) = link.block.apply(differences).rowwise() + child.row(0);
  return child;
}

}  // namespace sublimit
