// SPDX-License-Identifier: Apache-2.0
#include "sublimit/curves/detail/curve_vertex.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/core/detail/left_eigenvector.h"
#include "sublimit/core/detail/submatrix.h"
#include "sublimit/neighborhood/closed_set.h"

namespace sublimit {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// Returns the indices of the unknowns between two positions and of all that these depend on, ascending.
std::vector<Index> closure(const CurveNeighborhood& n, std::int64_t from, std::int64_t to) {
  std::vector<Index> between;
  for (size_t i = 0; i < n.unknowns.size(); ++i)
    if (n.unknowns[i].position >= from && n.unknowns[i].position <= to) between.push_back(static_cast<Index>(i));
  return closed_set(n.A, between);
}

/// Returns the number of eigenvalues with modulus >= `value`. The tolerance is 1e-6, since rounding moves a double
/// eigenvalue by up to 1e-7.
int eigenvalues_from(const Matrix& A, double value) {
  return static_cast<int>((eigenvalues(A).cwiseAbs().array() >= value * (1 - 1e-6)).count());
}

/// Returns the left eigenvector without what rounding leaves of zeros.
std::optional<Vector> mask(const Matrix& A, double value, const Vector& scale) {
  std::optional<Vector> l = left_eigenvector(A, value, scale);
  if (!l) return l;
  const double least = std::numeric_limits<double>::epsilon() * l->cwiseAbs().maxCoeff();
  return l->unaryExpr([least](double x) { return std::abs(x) < least ? 0 : x; });
}

/// Computes a second derivative from unknowns on one side of a vertex, or at an end from all.
/// @param from, to  range of positions of that side
/// @param backward  the side is that before the vertex
/// @param row       result, zero on entry
/// @return  false if the derivative does not exist or is not known
bool second_derivative(const CurveNeighborhood& n, std::int64_t radius, std::int64_t from, std::int64_t to,
                       bool backward, Eigen::RowVectorXd& row) {
  std::vector<Index> points = closure(n, from, to);
  if (backward) std::reverse(points.begin(), points.end());  // away from the vertex
  const Matrix A = n.A(points, points);
  const Eigen::Index size = A.rows();
  const int large = eigenvalues_from(A, 0.25);
  if (large == 2) return true;  // straight to second order, whatever the points
  if (large != 3 || size < 5) return false;
  // The points whose limit is half the square of the parameter: far from the vertex their second difference is 1.
  const auto difference = [&](Eigen::Index from_last) {
    Vector weights = Vector::Zero(size);
    weights[size - 3 - from_last] = weights[size - 1 - from_last] = 1;
    weights[size - 2 - from_last] = -2;
    return weights;
  };
  const std::optional<Vector> parabola = mask(A.transpose(), 1.0 / 4, difference(0));
  if (!parabola) return false;
  for (Eigen::Index i : {1, 2})
    if (const double error = difference(i).dot(*parabola) - 1; error > 1e-9 || error < -1e-9) return false;
  // Weights are within the radius alone.
  const std::vector<Index> near = closure(n, std::max(from, -radius), std::min(to, radius));
  Vector scale(near.size());
  for (size_t i = 0; i < near.size(); ++i)
    scale[Eigen::Index(i)] = (*parabola)[std::find(points.begin(), points.end(), near[i]) - points.begin()];
  const std::optional<Vector> found = mask(n.A(near, near), 1.0 / 4, scale);
  if (!found) return false;
  for (size_t i = 0; i < near.size(); ++i) row[n.unknowns[near[i]].column] = (*found)[Eigen::Index(i)];
  return true;
}

}  // namespace

CurveNeighborhood curve_neighborhood(const CurveScheme<double>& scheme, const CurveOutline& curve, int level,
                                     std::int64_t vertex, int margin) {
  const CurveLayout layout(scheme, level);
  const CurveOutline child = layout.child(curve);
  const CurveMatrix<double> S = curve_matrix(scheme, {curve}, level);
  const std::int64_t radius = layout.radius() + margin, reach = radius + 2 * layout.end_points();
  CurveNeighborhood all;
  std::vector<Index> columns, children;  // unknowns, and their children the same way from the child of the vertex
  for (Index a = 0; a < curve.size; ++a) {
    const std::int64_t offset = layout.position(curve, a) - vertex;
    if (offset < -reach || offset > reach) continue;
    const Index child_point = layout.point(child, offset + 2 * vertex);
    for (int component = 0; component < layout.unknowns(); ++component) {
      columns.push_back(a * layout.unknowns() + component);
      all.unknowns.push_back({offset, component, columns.back()});
      children.push_back(child_point * layout.unknowns() + component);
    }
  }
  all.A = submatrix(S, children, columns);
  const std::vector<Index> kept = closure(all, -radius, radius);
  CurveNeighborhood result;
  for (const Index i : kept) result.unknowns.push_back(all.unknowns[i]);
  result.A = all.A(kept, kept);
  return result;
}

int CurveVertex::order() const {
  if (!has_first) return 0;
  if (!has_second[0] || !has_second[1]) return 1;
  const double scale = 1 + second[0].cwiseAbs().maxCoeff();
  return (second[0] - second[1]).cwiseAbs().maxCoeff() <= 1e-9 * scale ? 2 : 1;
}

CurveVertex curve_vertex(const CurveScheme<double>& scheme, const CurveOutline& curve, int level, std::int64_t vertex) {
  const CurveNeighborhood n = curve_neighborhood(scheme, curve, level, vertex, curve_margin);
  const CurveLayout layout(scheme, level);
  const std::int64_t radius = layout.radius(), far = std::max(-n.unknowns.front().position, n.unknowns.back().position);
  CurveVertex result;
  result.first = result.second[0] = result.second[1] = Eigen::RowVectorXd::Zero(curve.size * layout.unknowns());
  const std::vector<Index> points = closure(n, -radius, radius);
  const Matrix A = n.A(points, points);
  Vector x(points.size());  // values of the parameter, in edges
  for (size_t i = 0; i < points.size(); ++i) {
    const CurveUnknown& unknown = n.unknowns[points[i]];
    x[Eigen::Index(i)] = unknown.component == 0 ? static_cast<double>(unknown.position) / 2 : 1;
  }
  const std::optional<Vector> first = mask(A, 1.0 / 2, x);
  result.has_first = first && eigenvalues_from(A, 0.5) == 2;
  if (!result.has_first) return result;
  for (size_t i = 0; i < points.size(); ++i) result.first[n.unknowns[points[i]].column] = (*first)[Eigen::Index(i)];
  if (layout.unknowns() > 1) return result;
  const bool is_start = vertex == 0, is_end = vertex == layout.end(curve);
  for (const int side : {0, 1}) {
    const bool before = is_end || (side == 0 && !is_start);
    result.has_second[side] = second_derivative(n, radius, before || is_start ? -far : 0, before && !is_end ? 0 : far,
                                                before, result.second[side]);
  }
  return result;
}

}  // namespace sublimit
