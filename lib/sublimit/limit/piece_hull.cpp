// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/piece_hull.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "sublimit/core/binomial.h"

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

}  // namespace

Eigen::Vector2d BernsteinNets::in_quarter(int k, bool triangle, double u, double v) {
  if (triangle && k == 3) return {1 - 2 * u, 1 - 2 * v};  // the middle one lies upside down
  return {2 * u - (k & 1), 2 * v - (k >> 1)};
}

Eigen::MatrixXd bernstein_from(const PolynomialBasis& basis) {
  Eigen::MatrixXd ours(basis.size(), basis.size());
  for_each_node(basis, [&](int row, double u, double v) { ours.row(row) = basis.at(u, v, 0); });
  return nodes_of(basis).fullPivLu().solve(ours);
}

BernsteinNets::BernsteinNets(const PolynomialBasis& basis) : from_basis_(bernstein_from(basis)) {
  const int n = basis.size();
  const bool triangle = basis.total();
  const Eigen::FullPivLU<Eigen::MatrixXd> interpolation(nodes_of(basis));
  for (int k = 0; k < 4; ++k) {
    Eigen::MatrixXd values(n, n);
    for_each_node(basis, [&](int row, double u, double v) {
      const bool turned = triangle && k == 3;
      values.row(row) = turned ? bernstein(basis.degree(), true, (1 - u) / 2, (1 - v) / 2)
                               : bernstein(basis.degree(), triangle, (u + (k & 1)) / 2, (v + (k >> 1)) / 2);
    });
    quarters_[size_t(k)] = interpolation.solve(values);
  }
}

Points child_points(const PieceLink& link, const Points& points) {
  const Points differences = points.bottomRows(points.rows() - 1).rowwise() - points.row(0);
  Points child(link.block.child_slots(), points.cols());
  child.row(0) = points.row(0) + link.block.origin() * differences;
  child.bottomRows(child.rows() - 1) = link.block.apply(differences).rowwise() + child.row(0);
  return child;
}

}  // namespace sublimit
