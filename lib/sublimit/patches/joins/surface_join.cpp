// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/joins/surface_join.h"

#include <cmath>

#include "sublimit/patches/spline_surface.h"

namespace sublimit {
namespace {

int column_width(const BezierPatch<double>& patch) { return patch.coordinates == Coordinates::homogeneous ? 4 : 3; }

/// Columns of points seen from another origin, w (x - origin).
void move_origin(BezierPatch<double>& patch, const std::array<double, 3>& origin) {
  const auto width = static_cast<size_t>(column_width(patch));
  for (size_t at = 0; at < patch.columns.size(); at += width)
    for (size_t k = 0; k < 3; ++k) patch.columns[at + k] -= origin[k] * (width == 4 ? patch.columns[at + 3] : 1);
}

/// The greatest column, in x and in w, times the sum of a derivative's absolute weights: what terms could be.
struct ColumnSizes {
  std::vector<double> x, w;  // by order
};
ColumnSizes column_sizes(const BezierPatch<double>& patch, bool at_end, int orders) {
  double x = 0, w = 0;
  const auto width = static_cast<size_t>(column_width(patch));
  for (size_t at = 0; at < patch.columns.size(); at += width) {
    x = std::max(x, std::hypot(patch.columns[at], patch.columns[at + 1], patch.columns[at + 2]));
    w = std::max(w, width == 4 ? std::abs(patch.columns[at + 3]) : 1.0);
  }
  const std::vector<double> rows = bezier_piece_detail::end_rows(patch.degree_u, at_end, orders, patch.length);
  ColumnSizes result;
  for (int r = 0; r <= orders; ++r) {
    double sum = 0;
    for (int i = 0; i <= patch.degree_u; ++i) sum += std::abs(rows[static_cast<size_t>(r * (patch.degree_u + 1) + i)]);
    result.x.push_back(sum * x);
    result.w.push_back(width == 4 || r == 0 ? sum * w : 0);
  }
  return result;
}

}  // namespace

RoundedOrder rounded_order(BezierPatch<double> left, BezierPatch<double> right, double tolerance) {
  using namespace surface_join_detail;
  const int highest = highest_order(left, right);
  std::array<double, 3> origin = {};
  const size_t corner = static_cast<size_t>(left.degree_u) * static_cast<size_t>(column_width(left));
  const double weight = column_width(left) == 4 ? left.columns[corner + 3] : 1;
  if (weight != 0)
    for (size_t k = 0; k < 3; ++k) origin[k] = left.columns[corner + k] / weight;
  move_origin(left, origin), move_origin(right, origin);
  const std::vector<LineColumn<double>> H = cross_derivatives(left, true, highest),
                                        K = cross_derivatives(right, false, highest);
  const ColumnSizes of_left = column_sizes(left, true, highest), of_right = column_sizes(right, false, highest);
  const auto agree = [&](int k) {
    const std::vector<double> choose = binomials<double>(k);
    double size = 0;
    for (int i = 0; i <= k; ++i) {
      const auto j = static_cast<size_t>(i), rest = static_cast<size_t>(k - i);
      size += choose[j] * (of_left.x[j] * of_right.w[rest] + of_right.x[j] * of_left.w[rest]);
    }
    for (size_t i = 0; i < 3; ++i) {
      const LinePolynomial<double> rest = difference(H, K, k, i);
      for (const double c : rest.coefficients())
        if (!(std::abs(c) <= tolerance * size)) return false;
    }
    return true;
  };
  RoundedOrder result;
  while (result.c < highest && agree(result.c + 1)) ++result.c;
  result.is_same = result.c == highest;
  return result;
}

SurfaceJoin surface_join(const BezierPatch<double>& left, const BezierPatch<double>& right,
                         const JoinTolerance& tolerance) {
  surface_join_detail::check(left, "left patch"), surface_join_detail::check(right, "right patch");
  const auto size_of = [](const BezierPatch<double>& patch) {
    Eigen::Array3d low = Eigen::Array3d::Constant(INFINITY), high = -low;
    const auto width = static_cast<size_t>(column_width(patch));
    for (size_t at = 0; at < patch.columns.size(); at += width) {
      const double w = width == 4 ? patch.columns[at + 3] : 1;
      if (w == 0) continue;
      const Eigen::Array3d x = Eigen::Map<const Eigen::Array3d>(&patch.columns[at]) / w;
      low = low.min(x), high = high.max(x);
    }
    return low[0] <= high[0] ? (high - low).matrix().norm() : 0;
  };
  const auto edge = [](const BezierPatch<double>& patch, double u) {
    const int width = column_width(patch);
    const Points columns = Eigen::Map<const Points>(patch.columns.data(), std::ssize(patch.columns) / width, width);
    const SplineSurface surface(bezier_knots<double>(patch.degree_u), bezier_knots<double>(patch.degree_v));
    return EdgeSide{.evaluate = [=, coordinates = patch.coordinates](std::span<const double> s) {
      std::vector<Place> places;
      for (const double v : s) places.push_back({.face = 0, .u = u, .v = v});
      return surface.evaluate(columns, places, 2, coordinates);
    }};
  };
  const int samples = 8 * (left.degree_v + right.degree_v) + 17;
  SurfaceJoin result;
  result.deviation = measured_deviation(edge(left, 1), edge(right, 0), samples);
  const RoundedOrder order = rounded_order(left, right, tolerance.distance);
  result.measured =
      measured_orders(result.deviation, order.c, order.is_same, std::max(size_of(left), size_of(right)), tolerance);
  return result;
}

}  // namespace sublimit
