// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/joins/edge_deviation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "sublimit/patches/joins/golden_section.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

/// A surface at a place of the edge.
struct EdgePoint {
  bool is_there = false, has_normal = false, has_curvature = false;
  Vector3d position, normal;
  double area = 0;       // |du x dv|
  double curvature = 0;  // of the section perpendicular to the edge
};

EdgePoint edge_point(const EdgeSide& side, const LimitSamples& at, Index i) {
  EdgePoint result;
  if (!(result.is_there = has_position(at.status[size_t(i)]))) return result;
  result.position = at.position.row(i);
  result.normal = side.sign * at.normal.row(i);
  result.has_normal = !result.normal.isZero(0);
  const Vector3d du = at.du.row(i), dv = at.dv.row(i), along = side.along_v ? dv : du;
  result.area = du.cross(dv).norm();
  if (!result.has_normal || result.area == 0 || along.isZero(0)) return result;
  // The unit vector across the edge is a du + b dv.
  const Vector3d n = at.normal.row(i), across = n.cross(along.normalized());
  const double a = n.dot(across.cross(dv)) / result.area, b = n.dot(du.cross(across)) / result.area;
  result.curvature =
      side.sign * (a * a * n.dot(at.duu.row(i)) + 2 * a * b * n.dot(at.duv.row(i)) + b * b * n.dot(at.dvv.row(i)));
  result.has_curvature = std::isfinite(result.curvature);
  return result;
}

std::vector<EdgePoint> edge_points(const EdgeSide& side, std::span<const double> s) {
  const LimitSamples at = side.evaluate(s);
  std::vector<EdgePoint> result;
  for (Index i = 0; i < std::ssize(s); ++i) result.push_back(edge_point(side, at, i));
  return result;
}

double greatest_area(const std::vector<EdgePoint>& points) {
  double area = 0;
  for (const EdgePoint& p : points) area = std::max(area, p.area);
  return area;
}

/// Both surfaces at a place. A normal where the area vanishes is a limit; one where it is small is rounding.
struct EdgePair {
  EdgePoint left, right;
  bool has_normals = false, has_curvatures = false;

  EdgePair(const EdgePoint& l, const EdgePoint& r, double area_l, double area_r) : left(l), right(r) {
    const auto is_sure = [](const EdgePoint& p, double greatest, double least) {
      return p.area >= least * greatest || p.area <= 1e-14 * greatest;
    };
    has_normals = l.has_normal && r.has_normal && is_sure(l, area_l, 1e-6) && is_sure(r, area_r, 1e-6);
    has_curvatures =
        has_normals && l.has_curvature && r.has_curvature && l.area >= 1e-3 * area_l && r.area >= 1e-3 * area_r;
  }
};

using Deviation = std::optional<double> (*)(const EdgePair&);

std::optional<double> gap(const EdgePair& at) {
  if (!at.left.is_there || !at.right.is_there) return std::nullopt;
  return (at.left.position - at.right.position).norm();
}
std::optional<double> angle(const EdgePair& at) {
  if (!at.has_normals) return std::nullopt;
  return 2 * std::atan2((at.left.normal - at.right.normal).norm(), (at.left.normal + at.right.normal).norm());
}
std::optional<double> curvature_jump(const EdgePair& at) {
  if (!at.has_curvatures) return std::nullopt;
  return std::abs(at.left.curvature - at.right.curvature);
}

}  // namespace

EdgeDeviation measured_deviation(const EdgeSide& left, const EdgeSide& right, int samples) {
  assert(samples >= 2);
  std::vector<double> s;
  for (int i = 0; i < samples; ++i) s.push_back(i / (samples - 1.0));
  const std::vector<EdgePoint> l = edge_points(left, s), r = edge_points(right, s);
  const double area_l = greatest_area(l), area_r = greatest_area(r);
  std::vector<EdgePair> pairs;
  EdgeDeviation result;
  double extent = 0;
  for (int i = 0; i < samples; ++i) {
    const EdgePair& pair = pairs.emplace_back(l[size_t(i)], r[size_t(i)], area_l, area_r);
    if (!pair.left.is_there || !pair.right.is_there) result.has_pole = true;
    if (pair.has_curvatures)
      result.greatest_curvature =
          std::max({result.greatest_curvature, std::abs(pair.left.curvature), std::abs(pair.right.curvature)});
    if (pair.left.is_there) extent = std::max(extent, pair.left.position.cwiseAbs().maxCoeff());
  }
  const auto pair_at = [&](double t) {
    return EdgePair(edge_points(left, {&t, 1})[0], edge_points(right, {&t, 1})[0], area_l, area_r);
  };
  const auto maximum = [&](Deviation deviation, double noise) -> std::optional<EdgeMaximum> {
    std::vector<double> values;
    for (const EdgePair& pair : pairs) values.push_back(deviation(pair).value_or(-1));
    const double greatest = *std::ranges::max_element(values);
    if (greatest < 0) return std::nullopt;
    EdgeMaximum best;
    best.value = -1;
    const auto consider = [&](double t, const EdgePair& pair, double value) {
      if (value <= best.value) return;
      best = {.value = value, .s = t, .point = {}};
      Eigen::Map<Vector3d>(best.point.data()) = pair.left.position;
    };
    for (int i = 0; i < samples; ++i) consider(s[size_t(i)], pairs[size_t(i)], values[size_t(i)]);
    if (greatest <= noise) return best;
    for (int i = 0; i < samples; ++i) {
      const double value = values[size_t(i)];
      const int before = std::max(i - 1, 0), after = std::min(i + 1, samples - 1);
      if (value < 0.9 * greatest || value < values[size_t(before)] || value < values[size_t(after)]) continue;
      if (value == values[size_t(before)] && before < i) continue;  // all the same: once is enough
      const auto at = [&](double t) {
        const EdgePair pair = pair_at(t);
        const double found = deviation(pair).value_or(-1);
        consider(t, pair, found);
        return found;
      };
      golden_section([&](double t) { return -at(t); }, s[size_t(before)], s[size_t(after)], 32);
    }
    return best;
  };
  result.gap = maximum(gap, 1e-14 * extent).value_or(EdgeMaximum{});
  result.angle = maximum(angle, 1e-12);
  result.curvature_jump = maximum(curvature_jump, 1e-12 * result.greatest_curvature);
  return result;
}

JoinOrders measured_orders(const EdgeDeviation& deviation, int c, bool is_same, double size,
                           const JoinTolerance& tolerance) {
  JoinOrders result;
  result.obstacle = JoinObstacle::pole;
  if (deviation.has_pole) return result;
  result.obstacle = JoinObstacle::gap;
  if (!(deviation.gap.value <= tolerance.distance * size)) return result;
  result.c = std::max(c, 0), result.g = 0, result.is_same = is_same;
  result.obstacle = JoinObstacle::no_tangent;
  if (!deviation.angle) return result;
  result.obstacle =
      deviation.angle->value >= std::numbers::pi - tolerance.angle ? JoinObstacle::folded_back : JoinObstacle::angle;
  if (!(deviation.angle->value <= tolerance.angle)) return result;
  result.g = 1;
  result.obstacle = JoinObstacle::curvature;
  if (!deviation.curvature_jump) return result;
  const double scale = std::max(deviation.greatest_curvature, 1 / size);
  if (!(deviation.curvature_jump->value <= tolerance.curvature * scale)) return result;
  result.g = std::max(2, result.c);
  result.obstacle = JoinObstacle::none;
  return result;
}

}  // namespace sublimit
