// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/cad_cells.h"

#include <Eigen/Dense>

#include <cmath>
#include <numbers>

#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/patches/detail/blossom.h"

namespace sublimit {

std::vector<std::array<double, 2>> corners_in_address(const CadCell& cell) {
  std::vector<std::array<double, 2>> at;
  for (size_t k = 0; k < (cell.triangle ? 3u : 4u); ++k) at.push_back(cell.corners[k].uv());
  return at;
}

std::array<std::array<double, 2>, 4> third_of_triangle(const std::vector<std::array<double, 2>>& c, size_t k) {
  const auto mean = [](const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return std::array<double, 2>{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
  };
  return {c[k],
          mean(c[k], c[(k + 1) % 3]),
          {(c[0][0] + c[1][0] + c[2][0]) / 3, (c[0][1] + c[1][1] + c[2][1]) / 3},
          mean(c[(k + 2) % 3], c[k])};
}

Eigen::VectorXd bernstein_values(int degree, double t) {
  Eigen::VectorXd values = Eigen::VectorXd::Unit(degree + 1, 0);
  for (int q = 1; q <= degree; ++q) blossom_step(UnitSpan<double>{}, q, UnitArgument<double>::point(t), values.data());
  return values;
}

std::vector<double> interpolation_nodes(int degree) {
  std::vector<double> nodes(size_t(degree) + 1);
  for (int k = 0; 2 * k <= degree; ++k) {
    nodes[size_t(k)] = 2 * k == degree ? 0.5 : (1 - std::cos(k * std::numbers::pi / degree)) / 2;
    nodes[size_t(degree - k)] = 1 - nodes[size_t(k)];
  }
  return nodes;
}

Eigen::MatrixXd interpolation(int degree) {
  const std::vector<double> nodes = interpolation_nodes(degree);
  Eigen::MatrixXd values(degree + 1, degree + 1);
  for (int k = 0; k <= degree; ++k) values.row(k) = bernstein_values(degree, nodes[size_t(k)]);
  return PivotedLu(values).inverse();
}

}  // namespace sublimit
