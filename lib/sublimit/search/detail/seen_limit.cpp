// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/detail/seen_limit.h"

#include <algorithm>
#include <cmath>

namespace sublimit {
namespace {

/// Between the steps of a grid a smooth function is off by an eighth of its second differences; limits of schemes
/// without polynomials bend more from level to level than such functions do, but by less than eight times.
double bend_of(const PieceGrid& grid, const Eigen::VectorXd& x) {
  constexpr int n = PieceGrid::steps;
  double most = 0;
  const auto look = [&](double second) { most = std::max(most, std::abs(second)); };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= grid.width(j); ++i) {
      const double at = x[grid.row(i, j)];
      const bool inside_u = i > 0 && i < grid.width(j);
      if (inside_u) look(x[grid.row(i - 1, j)] - 2 * at + x[grid.row(i + 1, j)]);
      if (j > 0 && j < n && i <= grid.width(j + 1)) look(x[grid.row(i, j - 1)] - 2 * at + x[grid.row(i, j + 1)]);
      if (grid.triangle && i > 0 && j > 0 && i <= grid.width(j) && j < n && i - 1 <= grid.width(j + 1) &&
          i + 1 <= grid.width(j - 1))
        look(x[grid.row(i - 1, j + 1)] - 2 * at + x[grid.row(i + 1, j - 1)]);
      if (i < grid.width(j) && j < n && i + 1 <= grid.width(j + 1))
        look(at - x[grid.row(i + 1, j)] - x[grid.row(i, j + 1)] + x[grid.row(i + 1, j + 1)]);
    }
  return most;
}

Eigen::Vector2d middle_of(bool triangle) {
  return triangle ? Eigen::Vector2d(1. / 3, 1. / 3) : Eigen::Vector2d(0.5, 0.5);
}

}  // namespace

Eigen::AlignedBox3d estimated_box(const PieceGrid& grid, const Points& limits) {
  Eigen::AlignedBox3d box;
  for (Eigen::Index i = 0; i < limits.rows(); ++i) box.extend(Eigen::Vector3d(limits.row(i)));
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  Eigen::Vector3d margin;
  for (int k = 0; k < 3; ++k) margin[k] = bend_of(grid, limits.col(k)) + 1e-14 * largest;
  return {box.min() - margin, box.max() + margin};
}

double SeenLimit::bend(const Eigen::VectorXd& values) const { return bend_of(grid_, values); }

bool SeenLimit::can_be_hit(double slack) const {
  constexpr double r = 0.70710678;
  const Eigen::Matrix<double, Eigen::Dynamic, 2> seen = limits_.leftCols<2>();
  const auto is_aside = [&](const Eigen::Vector2d& d) {
    const Eigen::VectorXd side = seen * d;
    const double off = slack + bend(side);
    return side.minCoeff() > off || side.maxCoeff() < -off;
  };
  const std::optional<Eigen::Vector2d> middle = facing(seen);
  return !(middle && is_aside(*middle)) && !is_aside({1, 0}) && !is_aside({0, 1}) && !is_aside({r, r}) &&
         !is_aside({r, -r});
}

SeenZero SeenLimit::zero(double slack, const std::function<Eigen::Vector3d(const Eigen::Vector2d&)>& at) const {
  constexpr int n = PieceGrid::steps;
  const bool triangle = grid_.triangle;
  // Derivatives of the map, as slopes between places of the grid: x and y by u, by v; and of the distance.
  std::array<std::vector<Eigen::Vector3d>, 2> slopes;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= grid_.width(j); ++i) {
      const Eigen::RowVector3d here = limits_.row(grid_.row(i, j));
      if (i < grid_.width(j)) slopes[0].push_back(n * (limits_.row(grid_.row(i + 1, j)) - here));
      if (j < n && i <= grid_.width(j + 1)) slopes[1].push_back(n * (limits_.row(grid_.row(i, j + 1)) - here));
    }
  Eigen::Matrix2d mean;
  Eigen::Vector2d steepest, along;  // slopes of the distance: the largest ones, and their means
  for (int by = 0; by < 2; ++by) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double most = 0;
    for (const Eigen::Vector3d& slope : slopes[size_t(by)]) sum += slope, most = std::max(most, std::abs(slope.z()));
    sum /= double(slopes[size_t(by)].size());
    mean.col(by) = sum.head<2>();
    along[by] = sum.z();
    steepest[by] = most;
  }
  if (!(std::abs(mean.determinant()) > 1e-9 * mean.squaredNorm())) return {SeenZero::Kind::unknown};
  const Eigen::Matrix2d first = mean.inverse();
  Eigen::Matrix2d middle, radius;
  for (int by = 0; by < 2; ++by) {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector3d& slope : slopes[size_t(by)]) box.extend(Eigen::Vector2d(first * slope.head<2>()));
    middle.col(by) = box.center();
    radius.col(by) = box.sizes() / 2;
  }
  if (!(middle.determinant() > 0.01)) return {SeenZero::Kind::unknown};
  const Eigen::Matrix2d inverse = middle.inverse() * first;
  const Points flattened = limits_.leftCols<2>() * inverse.transpose();
  const Eigen::Vector2d off_by_slack = inverse.cwiseAbs().rowwise().sum() * slack;
  for (int k = 0; k < 2; ++k) {
    const double bent = bend(flattened.col(k)), off = off_by_slack[k] + bent;
    if (flattened.col(k).minCoeff() > off || flattened.col(k).maxCoeff() < -off) return {SeenZero::Kind::none};
    radius.row(k).array() += 2 * n * bent;  // slopes within a step, beyond those between places
  }
  if (!((middle.inverse().cwiseAbs() * radius).norm() < 0.5)) return {SeenZero::Kind::unknown};

  const Eigen::Vector2d off = off_by_slack.array() + beyond_part;
  // Broyden's steps inside; on a side, and where they take long, by the matrix of the whole, which is sure to lead to a
  // zero.
  constexpr int most_by_secants = 12;
  Eigen::Matrix2d B = inverse;
  Eigen::Vector2d p = nearest_inside(middle_of(triangle) - inverse * at(middle_of(triangle)).head<2>(), triangle);
  Eigen::Vector3d x = at(p);
  for (int step = 0; step < 48; ++step) {
    const Eigen::Vector2d sure = nearest_inside(p - inverse * x.head<2>(), triangle);
    const Eigen::Vector2d move = inverse * x.head<2>();
    const bool is_hit = move.cwiseAbs().maxCoeff() <= 1e-15 || x.head<2>().norm() <= 1e-3 * slack;
    // Along a side, as near as makes no difference to what counts as on the ray.
    if (is_hit || (sure - p).cwiseAbs().maxCoeff() <= 1e-3 * off.minCoeff()) {
      if (!is_none(move, off, triangle)) return {SeenZero::Kind::none};
      return {SeenZero::Kind::one, p, x.z() - along.dot(move), steepest.dot(off), inverse.determinant() > 0 ? 1 : -1};
    }
    Eigen::Vector2d next = p - B * x.head<2>();
    if (step >= most_by_secants || nearest_inside(next, triangle) != next || next == p) next = sure;
    const Eigen::Vector3d there = at(next);
    const Eigen::Vector2d s = next - p, y = there.head<2>() - x.head<2>(), By = B * y;
    if (const double denominator = s.dot(By); std::abs(denominator) > 0.1 * s.squaredNorm())
      B += (s - By) * (s.transpose() * B) / denominator;
    p = next, x = there;
  }
  return {SeenZero::Kind::unknown};
}

}  // namespace sublimit
