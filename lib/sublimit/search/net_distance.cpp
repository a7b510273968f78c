// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/net_distance.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sublimit {
namespace {

using Box = Eigen::AlignedBox3d;

struct Interval {
  double low = 0, high = 0;
};
Interval operator+(const Interval& a, const Interval& b) { return {a.low + b.low, a.high + b.high}; }

Box box_of(const Points& net) {
  Box box;
  for (Eigen::Index i = 0; i < net.rows(); ++i) box.extend(Eigen::Vector3d(net.row(i)));
  return box;
}

/// Scalar products of vectors in two boxes; of one with itself, if they are the same box.
Interval dot(const Box& a, const Box& b) {
  Interval sum;
  for (int k = 0; k < 3; ++k) {
    const std::array<double, 4> p{a.min()[k] * b.min()[k], a.min()[k] * b.max()[k], a.max()[k] * b.min()[k],
                                  a.max()[k] * b.max()[k]};
    const auto [low, high] = std::minmax_element(p.begin(), p.end());
    sum = sum + Interval{&a == &b && a.min()[k] < 0 && a.max()[k] > 0 ? 0 : *low, *high};
  }
  return sum;
}

}  // namespace

NetDistance::NetDistance(const PolynomialBasis& basis, const Points& net, const Eigen::Vector3d& query, double rounding)
    : basis_(basis), net_(net.rowwise() - query.transpose()), rounding_(rounding) {}

double NetDistance::lower(const Eigen::Vector3d& towards) const {
  return std::max(box_of(net_).exteriorDistance(Eigen::Vector3d(Eigen::Vector3d::Zero())),
                  (net_ * towards).minCoeff()) -
         rounding_;
}

std::optional<ConvexMinimum> NetDistance::convex_minimum() const {
  const bool total = basis_.total();
  const NetDerivatives derivatives(basis_, net_, 2);
  const Box x = box_of(net_), u = box_of(derivatives.net(1, 0)), v = box_of(derivatives.net(0, 1));
  const auto second = [&](int du, int dv) {
    const Box box = box_of(derivatives.net(du, dv));
    return box.isEmpty() ? Interval{} : dot(x, box);
  };
  const Interval huu = dot(u, u) + second(2, 0), hvv = dot(v, v) + second(0, 2), huv = dot(u, v) + second(1, 1);
  const double off = std::max(std::abs(huv.low), std::abs(huv.high));
  if (!(huu.low > 0) || !(hvv.low > 0) || !(huu.low * hvv.low > off * off)) return std::nullopt;

  // Newton's method; each step goes to the smallest value of the quadratic model on the square or triangle.
  using Place = Eigen::Vector2d;
  std::array<Place, 4> corners{Place(0, 0), Place(1, 0), total ? Place(0, 1) : Place(1, 1), Place(0, 1)};
  const size_t count = total ? 3 : 4;
  const auto inside = [&](const Place& p) {
    return p.x() >= 0 && p.y() >= 0 && (total ? p.x() + p.y() <= 1 : p.x() <= 1 && p.y() <= 1);
  };
  Place p = total ? Place(1. / 3, 1. / 3) : Place(0.5, 0.5);
  ConvexMinimum best;
  double most = -std::numeric_limits<double>::infinity();
  for (int step = 0; step < 12; ++step) {
    const NetDerivatives::Jet j = derivatives.at(p.x(), p.y());
    const Eigen::Vector2d g(j.x.dot(j.u), j.x.dot(j.v));
    const double value = j.x.squaredNorm() / 2;
    double below = 0;  // of the tangent plane, on the square or triangle
    for (size_t k = 0; k < count; ++k) below = std::min(below, g.dot(corners[k] - p));
    if (value + below > most) {
      most = value + below;
      best = {0, j.x.norm(), {p.x(), p.y()}};
    }
    if (below >= -1e-17 * value || step == 11) break;
    Eigen::Matrix2d H;
    H << j.u.dot(j.u) + j.x.dot(j.uu), j.u.dot(j.v) + j.x.dot(j.uv), 0, j.v.dot(j.v) + j.x.dot(j.vv);
    H(1, 0) = H(0, 1);
    const auto model = [&](const Place& y) { return g.dot(y - p) + (y - p).dot(H * (y - p)) / 2; };
    Place next = p - Place(H.inverse() * g);
    if (!next.allFinite() || !inside(next)) {
      double least = std::numeric_limits<double>::infinity();
      for (size_t k = 0; k < count; ++k) {
        const Place a = corners[k], along = corners[(k + 1) % count] - a;
        const double bend = along.dot(H * along), slope = g.dot(along) + along.dot(H * (a - p));
        const Place y = a + (bend > 0 ? std::clamp(-slope / bend, 0.0, 1.0) : 0.0) * along;
        if (model(y) < least) least = model(y), next = y;
      }
    }
    p = next;
  }
  best.lower = std::max(0.0, std::sqrt(std::max(0.0, 2 * most)) - rounding_);
  return best;
}

}  // namespace sublimit
