// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/gregory_patch.h"

#include <utility>

#include "sublimit/patches/constructions/tensor_rows.h"

namespace sublimit {
namespace {

/// A function of u and v with its derivatives: value, u, v, uu, uv, vv.
using Jet = std::array<double, 6>;

Jet times(const Jet& f, const Jet& g) {
  return {f[0] * g[0],
          f[1] * g[0] + f[0] * g[1],
          f[2] * g[0] + f[0] * g[2],
          f[3] * g[0] + 2 * f[1] * g[1] + f[0] * g[3],
          f[4] * g[0] + f[1] * g[2] + f[2] * g[1] + f[0] * g[4],
          f[5] * g[0] + 2 * f[2] * g[2] + f[0] * g[5]};
}

/// x^2 y / (x + y); at the origin its second derivatives have no limit and are left 0.
Jet blended_product(double x, double y) {
  const double s = x + y;
  if (s == 0) return {};
  const double a = x / s, b = y / s;  // a + b = 1
  return {x * a * y, a * b * (x + 2 * y), x * a * a, 2 * b * b * b, a * a * (a + 3 * b), -2 * a * a * a};
}

/// F3(x) F3(y) x / (x + y) = (1-x)^2 (1-y)^2 x^2 y / (x + y), with the shares of x and y exchanged if `of_y`.
Jet share_of_twist(double x, double y, bool of_y) {
  Jet rational = of_y ? blended_product(y, x) : blended_product(x, y);
  if (of_y) std::swap(rational[1], rational[2]), std::swap(rational[3], rational[5]);
  const double p = 1 - x, q = 1 - y;
  return times(rational, {p * p * q * q, -2 * p * q * q, -2 * p * p * q, 2 * q * q, 4 * p * q, 2 * p * p});
}

}  // namespace

GregoryPatch::GregoryPatch(SplineSurface net, const std::array<bool, 4>& blended)
    : net_(std::move(net)), blended_(blended) {}

std::vector<Index> GregoryPatch::slots(Index face) const {
  std::vector<Index> points = net_.slots(face);
  const Index m = net_.u().num_points(), n = net_.v().num_points();
  for (Index corner = 0; corner < 4; ++corner) {
    points.push_back((corner % 2) * (m - 1) + (corner / 2) * (n - 1) * m);
    points.push_back(net_.num_points() + 2 * corner);
    points.push_back(net_.num_points() + 2 * corner + 1);
  }
  return points;
}

LimitStatus GregoryPatch::rows(const Place& place, int order, WeightRows& weights) const {
  const Parameters at = net_.parameters(place);
  const bool at_corner = (at.u == 0 || at.u == 1) && (at.v == 0 || at.v == 1);
  const bool unbounded = order == 2 && at_corner && blended_[size_t(at.u) + 2 * size_t(at.v)];
  WeightRows of_net;
  const LimitStatus status = net_.rows(place, unbounded ? 1 : order, of_net);
  weights = WeightRows::Zero(of_net.rows(), of_net.cols() + 12);
  weights.leftCols(of_net.cols()) = of_net;
  const auto [length_u, length_v] = net_.lengths(place.face);
  const double units[6] = {1, length_u, length_v, length_u * length_u, length_u * length_v, length_v * length_v};
  for (Eigen::Index corner = 0; corner < 4; ++corner) {
    if (!blended_[size_t(corner)]) continue;
    const bool right = corner % 2 == 1, top = corner / 2 == 1;
    const double x = right ? 1 - at.u : at.u, y = top ? 1 - at.v : at.v;
    // F4(u) = -F3(1 - u), and derivatives by u are those by -x.
    const double sign = right == top ? 1 : -1;
    const double turned[6] = {1, right ? -1.0 : 1, top ? -1.0 : 1, 1, right == top ? 1.0 : -1, 1};
    for (int field = 0; field < 2; ++field) {
      const Jet share = share_of_twist(x, y, field == 1);
      for (Eigen::Index r = 0; r < weights.rows(); ++r) {
        // The twist is what is taken away: S = .. - Hermite(u,v).
        const double weight = -sign * turned[r] * units[r] * share[size_t(r)];
        weights(r, of_net.cols() + 3 * corner + 1 + field) = weight;
        weights(r, of_net.cols() + 3 * corner) -= weight;
      }
    }
  }
  return unbounded ? LimitStatus::unbounded_second : status;
}

std::string GregoryPatch::type(Index face) const {
  // Rows depend on where in the whole square a face is.
  std::string bytes = "gregory" + net_.type(face);
  const Parameters low = net_.parameters({face, 0, 0}), high = net_.parameters({face, 1, 1});
  const double square[4] = {low.u, low.v, high.u, high.v};
  append_bytes(bytes, square);
  for (const bool corner : blended_) bytes += corner ? '1' : '0';
  return bytes;
}

GregoryNet gregory_patch(const CoonsBoundary& curves, const CoonsFields& fields, double tolerance) {
  const CheckedCoons checked = checked_coons(curves, fields, tolerance);
  Points twists(4, 3);
  std::array<bool, 4> blended{};
  for (Eigen::Index i = 0; i < 4; ++i) {
    const Eigen::RowVector3d of_xv = checked.twists_of_xv.row(i), of_xu = checked.twists_of_xu.row(i);
    blended[size_t(i)] = !((of_xv - of_xu).norm() <= checked.tolerance);
    twists.row(i) = blended[size_t(i)] ? Eigen::RowVector3d(0, 0, 0) : Eigen::RowVector3d((of_xv + of_xu) / 2);
  }
  const SplineNet net = built(general_coons_builder(checked.knots()), checked.data(twists), Coordinates::plain);
  Points columns(net.columns.rows() + 8, 3);
  columns.topRows(net.columns.rows()) = net.columns;
  const Index m = net.surface->u().num_points(), n = net.surface->v().num_points();
  for (Eigen::Index i = 0; i < 4; ++i) {
    const Eigen::RowVector3d corner = net.columns.row((i % 2) * (m - 1) + (i / 2) * (n - 1) * Eigen::Index{m});
    columns.row(net.columns.rows() + 2 * i) = corner + checked.twists_of_xu.row(i);
    columns.row(net.columns.rows() + 2 * i + 1) = corner + checked.twists_of_xv.row(i);
  }
  return {std::make_shared<const GregoryPatch>(*net.surface, blended), std::move(columns)};
}

}  // namespace sublimit
