// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/seen_net.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sublimit/limit/net_derivatives.h"

namespace sublimit {

RayFrame::RayFrame(const Eigen::Vector3d& from, const Eigen::Vector3d& direction)
    : origin(from), length(direction.stableNorm()) {
  const Eigen::Vector3d d = direction / length;
  Eigen::Index least = 0;
  d.cwiseAbs().minCoeff(&least);
  axes.row(0) = d.cross(Eigen::Vector3d(Eigen::Vector3d::Unit(least))).normalized();
  axes.row(1) = d.cross(Eigen::Vector3d(axes.row(0)));
  axes.row(2) = d;
}

Points RayFrame::seen(const Points& net) const {
  if (net.cols() == 3) return (net.rowwise() - origin.transpose()) * axes.transpose();
  Points seen(net.rows(), 4);
  seen << (net.leftCols<3>() - net.col(3) * origin.transpose()) * axes.transpose(), net.col(3);
  return seen;
}

bool SeenNet::can_be_hit(double slack) const {
  constexpr std::array<std::array<double, 2>, 4> directions{
      {{1, 0}, {0, 1}, {0.70710678, 0.70710678}, {0.70710678, -0.70710678}}};
  for (const auto& [a, b] : directions) {
    Eigen::VectorXd side = a * net_.col(0) + b * net_.col(1);
    if (is_rational()) side.array() /= net_.col(3).array();
    if (side.minCoeff() > slack || side.maxCoeff() < -slack) return false;
  }
  return true;
}

SeenNet::Zero SeenNet::zero(double slack) const {
  const NetDerivatives x(basis_, net_, 1);
  Eigen::Matrix2d middle, radius;
  for (int by = 0; by < 2; ++by) {  // columns: derivatives across the ray, by u and by v
    const Points& net = x.net(1 - by, by);
    const Eigen::Vector2d low = net.leftCols<2>().colwise().minCoeff(), high = net.leftCols<2>().colwise().maxCoeff();
    middle.col(by) = (low + high) / 2;
    radius.col(by) = (high - low) / 2;
  }
  if (!(std::abs(middle.determinant()) > 1e-12 * middle.squaredNorm())) return {Zero::Kind::unknown};
  const Eigen::Matrix2d inverse = middle.inverse();
  // At most that much of the distance to a zero is left after a step by the inverse of the middle, and going back to
  // the nearest place of the domain adds nothing.
  if (!((inverse.cwiseAbs() * radius).norm() < 0.5)) return {Zero::Kind::unknown};
  Eigen::Vector2d p = basis_.total() ? Eigen::Vector2d(1. / 3, 1. / 3) : Eigen::Vector2d(0.5, 0.5), move;
  NetDerivatives::Jet jet;
  for (int step = 0; step < 64; ++step) {
    jet = x.at(p.x(), p.y());
    move = inverse * jet.x.head<2>();  // no denominator is 0: zeros are those of the numerators
    const Eigen::Vector2d next = nearest_inside(p - move);
    const bool done = (next - p).cwiseAbs().maxCoeff() < 1e-16;
    p = next;
    if (done) break;
  }
  // What the neighbour may miss by as much as rounding moves zeros is taken here too.
  const double largest = is_rational() ? net_.col(3).maxCoeff() : 1;
  const Eigen::Vector2d off = (inverse.cwiseAbs().rowwise().sum() * (slack * largest)).array() + beyond_part;
  if (!(move.cwiseAbs().maxCoeff() <= off.maxCoeff())) return {Zero::Kind::none};
  const double w = is_rational() ? jet.x[3] : 1, s = jet.x[2] / w;
  const double su = (jet.u[2] - s * jet.u[3]) / w, sv = (jet.v[2] - s * jet.v[3]) / w;
  return {Zero::Kind::one, p, s, std::abs(su) * off[0] + std::abs(sv) * off[1]};
}

Eigen::Vector2d SeenNet::nearest_inside(const Eigen::Vector2d& p) const {
  if (!basis_.total()) return p.cwiseMax(0).cwiseMin(1);
  if (p.x() >= 0 && p.y() >= 0 && p.x() + p.y() <= 1) return p;
  if (p.x() + p.y() <= 1 || p.x() - p.y() > 1 || p.y() - p.x() > 1) {
    const Eigen::Vector2d q = p.cwiseMax(0).cwiseMin(1);
    if (q.x() + q.y() <= 1) return q;
  }
  const double u = std::clamp((p.x() - p.y() + 1) / 2, 0.0, 1.0);
  return {u, 1 - u};
}

}  // namespace sublimit
