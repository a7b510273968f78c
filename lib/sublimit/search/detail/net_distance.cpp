// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/detail/net_distance.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sublimit {
namespace {

using Box = Eigen::AlignedBox<double, 4>;

struct Interval {
  double low = 0, high = 0;
};
Interval operator+(const Interval& a, const Interval& b) { return {a.low + b.low, a.high + b.high}; }

Box box_of(const NetDerivatives::Coefficients& net) {
  Box box;
  for (Eigen::Index i = 0; i < net.rows(); ++i) box.extend(Eigen::Vector4d(net.row(i)));
  return box;
}

/// The quadratic form: the last side counts against the others.
double product(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  return a.head<3>().dot(b.head<3>()) - a[3] * b[3];
}

/// Products of vectors in two boxes; of one with itself, if they are the same box.
Interval product(const Box& a, const Box& b) {
  Interval sum;
  for (int k = 0; k < 4; ++k) {
    const std::array<double, 4> p{a.min()[k] * b.min()[k], a.min()[k] * b.max()[k], a.max()[k] * b.min()[k],
                                  a.max()[k] * b.max()[k]};
    const auto [least, most] = std::minmax_element(p.begin(), p.end());
    const double low = &a == &b && a.min()[k] < 0 && a.max()[k] > 0 ? 0 : *least;
    sum = sum + (k < 3 ? Interval{low, *most} : Interval{-*most, -low});
  }
  return sum;
}

}  // namespace

NetDistance::NetDistance(const PolynomialBasis& basis, const Points& net, const Eigen::Vector3d& query, double rounding)
    : basis_(basis), net_(net), rounding_(rounding) {
  if (is_rational())
    net_.leftCols<3>() -= net.col(3) * query.transpose();
  else
    net_.rowwise() -= query.transpose();
}

double NetDistance::lower(const Eigen::Vector3d& towards) const {
  Eigen::AlignedBox3d box;
  double along = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < net_.rows(); ++i) {
    const Eigen::Vector3d x = net_point(net_, i);
    box.extend(x);
    along = std::min(along, x.dot(towards));
  }
  return std::max(box.exteriorDistance(Eigen::Vector3d(Eigen::Vector3d::Zero())), along) - rounding_;
}

std::optional<ConvexMinimum> NetDistance::convex_minimum(double distance) const {
  const bool total = basis_.total();
  const double d = is_rational() ? distance : 0;
  if (is_rational() && !(d > 0)) return std::nullopt;
  Points scaled = net_;
  if (is_rational()) scaled.col(3) *= d;
  const NetDerivatives derivatives(basis_, scaled, 2);
  const Box x = box_of(derivatives.net(0, 0)), u = box_of(derivatives.net(1, 0)), v = box_of(derivatives.net(0, 1));
  const auto second = [&](int du, int dv) { return product(x, box_of(derivatives.net(du, dv))); };
  const Interval huu = product(u, u) + second(2, 0), hvv = product(v, v) + second(0, 2),
                 huv = product(u, v) + second(1, 1);
  const double off = std::max(std::abs(huv.low), std::abs(huv.high));
  if (!(huu.low > 0) || !(hvv.low > 0) || !(huu.low * hvv.low > off * off)) return std::nullopt;

  // Newton's method; each step goes to the smallest value of the quadratic model on the square or triangle.
  using PieceCoordinates = Eigen::Vector2d;
  std::array<PieceCoordinates, 4> corners{PieceCoordinates(0, 0), PieceCoordinates(1, 0),
                                          total ? PieceCoordinates(0, 1) : PieceCoordinates(1, 1),
                                          PieceCoordinates(0, 1)};
  const size_t count = total ? 3 : 4;
  const auto inside = [&](const PieceCoordinates& p) {
    return p.x() >= 0 && p.y() >= 0 && (total ? p.x() + p.y() <= 1 : p.x() <= 1 && p.y() <= 1);
  };
  PieceCoordinates p = total ? PieceCoordinates(1. / 3, 1. / 3) : PieceCoordinates(0.5, 0.5);
  ConvexMinimum best;
  double most = -std::numeric_limits<double>::infinity();
  for (int step = 0; step < 12; ++step) {
    const NetDerivatives::Jet j = derivatives.at(p.x(), p.y());
    const Eigen::Vector2d g(product(j.x, j.u), product(j.x, j.v));
    const double value = product(j.x, j.x) / 2, square = j.x.head<3>().squaredNorm();
    double below = 0;  // of the tangent plane, on the square or triangle
    for (size_t k = 0; k < count; ++k) below = std::min(below, g.dot(corners[k] - p));
    if (value + below > most) {
      most = value + below;
      best = {0, is_rational() ? std::sqrt(square) * d / j.x[3] : std::sqrt(square), {p.x(), p.y()}};
    }
    if (below >= -1e-17 * square / 2 || step == 11) break;
    Eigen::Matrix2d H;
    H << product(j.u, j.u) + product(j.x, j.uu), product(j.u, j.v) + product(j.x, j.uv), 0,
        product(j.v, j.v) + product(j.x, j.vv);
    H(1, 0) = H(0, 1);
    const auto model = [&](const PieceCoordinates& y) { return g.dot(y - p) + (y - p).dot(H * (y - p)) / 2; };
    PieceCoordinates next = p - PieceCoordinates(H.inverse() * g);
    if (!next.allFinite() || !inside(next)) {
      double least = std::numeric_limits<double>::infinity();
      for (size_t k = 0; k < count; ++k) {
        const PieceCoordinates a = corners[k], along = corners[(k + 1) % count] - a;
        const double bend = along.dot(H * along), slope = g.dot(along) + along.dot(H * (a - p));
        const PieceCoordinates y = a + (bend > 0 ? std::clamp(-slope / bend, 0.0, 1.0) : 0.0) * along;
        if (model(y) < least) least = model(y), next = y;
      }
    }
    p = next;
  }
  // |x - q|^2 >= d^2 + 2 most / w^2
  const double w = !is_rational() ? 1 : most < 0 ? net_.col(3).minCoeff() : net_.col(3).maxCoeff();
  best.lower = std::max(0.0, std::sqrt(std::max(0.0, d * d + 2 * most / (w * w))) - rounding_);
  return best;
}

}  // namespace sublimit
