// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/patch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <utility>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/source/detail/derivative_order.h"

namespace sublimit {
namespace {

/// Unit normal of derivatives that are not parallel, as far as rounding tells, else zero.
Eigen::Vector3d plain_normal(const RowValues& at) {
  if (!(at.sizes[1] > 0) || !(at.sizes[2] > 0)) return Eigen::Vector3d::Zero();
  // In units of their terms: squares of huge or tiny ones would leave the range of numbers.
  const Eigen::Vector3d du = at.values.row(1) / at.sizes[1], dv = at.values.row(2) / at.sizes[2];
  const Eigen::Vector3d normal = du.cross(dv);
  const double noise = 64 * std::numeric_limits<double>::epsilon() * (du.norm() + dv.norm());
  return normal.norm() > noise ? normal.normalized() : Eigen::Vector3d::Zero();
}

}  // namespace

bool Patch::is_inside(const Place& s) const {
  const FaceCount all = faces();
  return s.face >= 0 && s.face < all.size && s.u >= 0 && s.v >= 0 &&
         (all.triangles ? s.u + s.v <= 1 : s.u <= 1 && s.v <= 1);
}

LimitStencil Patch::stencil(const Place& place, int order) const {
  check_order(order);
  const auto [size, triangles] = faces();
  const char* const shape = triangles ? "triangle" : "square";
  if (place.face < 0 || place.face >= size)
    throw InvalidParameter("face " + format_number(place.face) + " does not exist; there are " + format_number(size) +
                           " " + shape + "s");
  if (!is_inside(place))
    throw InvalidParameter("(" + format_number(place.u) + ", " + format_number(place.v) + ") is outside the " + shape +
                           (triangles ? " u, v >= 0, u + v <= 1" : " 0 <= u, v <= 1"));
  LimitStencil result;
  WeightRows weights;
  result.status = rows(place, order, weights);
  const std::vector<Index> own = slots(place.face);
  for (size_t i = 0; i < own.size(); ++i)
    if (!weights.col(Eigen::Index(i)).isZero(0)) result.vertices.push_back(own[i]);
  std::ranges::sort(result.vertices);
  result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()), result.vertices.end());
  result.weights = WeightRows::Zero(weights.rows(), std::ssize(result.vertices));
  for (size_t i = 0; i < own.size(); ++i) {
    const auto at = std::ranges::lower_bound(result.vertices, own[i]);
    if (at == result.vertices.end() || *at != own[i]) continue;
    result.weights.col(at - result.vertices.begin()) += weights.col(Eigen::Index(i));
  }
  if (result.weights.rows() >= 3) result.tangents = result.weights.middleRows(1, 2);
  return result;
}

void product_rows(std::span<const double> u, Eigen::Index m, std::span<const double> v, Eigen::Index n, int order,
                  WeightRows& weights) {
  constexpr std::pair<int, int> orders[] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  weights.resize(order == 0 ? 1 : order == 1 ? 3 : 6, m * n);
  for (Eigen::Index r = 0; r < weights.rows(); ++r)
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index i = 0; i < m; ++i)
        weights(r, i + m * j) = v[size_t(orders[r].second * n + j)] * u[size_t(orders[r].first * m + i)];
}

LimitSamples empty_samples(Eigen::Index count, int order) {
  LimitSamples out;
  set_empty(count, order, out);
  return out;
}

WeightRows outer_product(const WeightRows& v, const WeightRows& u) {
  WeightRows rows(v.rows() * u.rows(), v.cols() * u.cols());
  for (Eigen::Index j = 0; j < v.rows(); ++j)
    for (Eigen::Index k = 0; k < v.cols(); ++k)
      rows.block(j * u.rows(), k * u.cols(), u.rows(), u.cols()) = v(j, k) * u;
  return rows;
}

void set_empty(Eigen::Index count, int order, LimitSamples& out) {
  Points* const targets[] = {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv};
  for (int k = 0; k < 6; ++k) targets[k]->setZero(k == 0 || order >= (k < 3 ? 1 : 2) ? count : 0, 3);
  out.normal.setZero(order >= 1 ? count : 0, 3);
  out.status.assign(static_cast<size_t>(count), LimitStatus::outside);
  out.order.assign(static_cast<size_t>(count), 0);
}

void Patch::evaluate(const Points& columns, Coordinates coordinates, const Place& place, int order, LimitSamples& out,
                     Eigen::Index i) const {
  if (!is_inside(place)) return;
  WeightRows weights;
  LimitStatus status = rows(place, order, weights);
  const RowValues at = row_values(weights, 2, columns(slots(place.face), Eigen::all), coordinates, is_affine());
  out.status[size_t(i)] = at.is_pole ? LimitStatus::pole : status;
  if (at.is_pole) return;
  const Eigen::Index count = at.values.rows();
  out.order[size_t(i)] = static_cast<std::int8_t>(count == 1 ? 0 : count == 3 ? 1 : 2);
  Points* const targets[] = {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv};
  for (Eigen::Index k = 0; k < count; ++k) targets[k]->row(i) = at.values.row(k);
  if (order == 0) return;
  Eigen::Vector3d normal = count >= 3 ? plain_normal(at) : Eigen::Vector3d::Zero();
  if (normal.isZero(0)) normal = limit_normal(columns, coordinates, place);
  out.normal.row(i) = normal;
  if (normal.isZero(0)) out.status[size_t(i)] = LimitStatus::undefined_normal;
}

LimitSamples Patch::evaluate(const Points& columns, std::span<const Place> samples, int order,
                             Coordinates coordinates) const {
  check_order(order);
  check_columns(columns, num_points(), coordinates);
  LimitSamples out = empty_samples(std::ssize(samples), order);
  parallel_for_blocks(
      std::ssize(samples),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i)
          evaluate(columns, coordinates, samples[static_cast<size_t>(i)], order, out, i);
      },
      256);
  return out;
}

}  // namespace sublimit
