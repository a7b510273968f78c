// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/detail/collapsed_side.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/patches/detail/spline_rows.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

/// The one point that homogeneous columns are; nothing if they are several, or a direction.
std::optional<Eigen::RowVector3d> one_point(const Points& columns, double noise) {
  Eigen::Index heaviest = 0;
  columns.col(3).cwiseAbs().maxCoeff(&heaviest);
  if (columns(heaviest, 3) == 0) return std::nullopt;
  const Eigen::RowVector3d point = columns.row(heaviest).head(3) / columns(heaviest, 3);
  for (const auto& column : columns.rowwise())
    if (!((column.head(3) - column[3] * point).norm() <= noise)) return std::nullopt;
  return point;
}

/// A direction of the surface, and the place of a sample in it.
struct Direction {
  const Knots<double>& knots;
  KnotPlace<double> place;
  Index stride;  ///< from a control point to the next
};

/// Control vectors of the derivative across a side that is one point, along the side; empty if it is not.
/// @param across  the parameter that goes inwards, and the place on the side
std::vector<Vector3d> vectors_at_point(const Points& columns, bool rational, const Direction& across,
                                       const Direction& along) {
  constexpr double ulps = 64 * std::numeric_limits<double>::epsilon();
  const PointRows rows = point_rows(across.knots, across.place, 1);
  double size = 0;  // of the terms of sums
  const auto sum = [&](int r, Index point_along) {
    Eigen::RowVector4d value(0, 0, 0, 0);
    double terms = 0;
    for (size_t j = 0; j < rows.points.size(); ++j) {
      const Index point = rows.points[j] * across.stride + point_along * along.stride;
      const double weight = rows.weights(r, Eigen::Index(j));
      value.head(columns.cols()) += weight * columns.row(point);
      terms += std::abs(weight) * columns.row(point).cwiseAbs().maxCoeff();
      if (!rational && r == 0) value[3] += weight;
    }
    size = std::max(size, terms);
    return value;
  };
  // What the sample's own piece has there comes first: a side can be long, and most samples are on none that is a
  // point.
  const Index p = along.knots.degree(), first = along.knots.span(along.place.face) - p;
  Points near(p + 1, 4);
  for (Index i = 0; i <= p; ++i) near.row(i) = sum(0, along.knots.point(first + i));
  if (!one_point(near, ulps * size)) return {};
  const Index num_along = along.knots.num_points();
  Points ends(num_along, 4), inwards(num_along, 4);
  for (Index i = 0; i < num_along; ++i) ends.row(i) = sum(0, i), inwards.row(i) = sum(1, i);
  const double noise = ulps * columns.cwiseAbs().maxCoeff();
  const std::optional<Eigen::RowVector3d> point = one_point(ends, noise);
  if (!point) return {};
  std::vector<Vector3d> vectors;
  for (Index i = 0; i < num_along; ++i) {
    const Vector3d vector = inwards.row(i).head(3) - inwards(i, 3) * *point;
    if (vector.norm() > noise) vectors.push_back(vector);
  }
  return vectors;
}

/// The normal of the plane that vectors turn in, counter-clockwise seen from its tip; zero if they are in no plane,
/// turn both ways or more than once.
Vector3d turning_normal(const std::vector<Vector3d>& vectors, bool is_closed) {
  if (vectors.size() < 2) return Vector3d::Zero();
  Eigen::MatrixXd M(vectors.size(), 3);
  for (size_t i = 0; i < vectors.size(); ++i) M.row(Eigen::Index(i)) = vectors[i];
  const SingularValues span = singular_values(M);
  constexpr double flat = 1e-9;
  if (span.values[1] <= flat * span.values[0]) return Vector3d::Zero();
  if (span.values.size() > 2 && span.values[2] > flat * span.values[0]) return Vector3d::Zero();
  const Vector3d normal = span.right.col(2);
  double least = 0, most = 0, turn = 0;
  for (size_t i = is_closed ? 0 : 1; i < vectors.size(); ++i) {
    const Vector3d& from = vectors[i == 0 ? vectors.size() - 1 : i - 1];
    const double angle = std::atan2(normal.dot(from.cross(vectors[i])), from.dot(vectors[i]));
    if (std::abs(angle) > std::numbers::pi - flat) return Vector3d::Zero();  // it could be either way
    least = std::min(least, angle), most = std::max(most, angle), turn += angle;
  }
  if ((least < -flat && most > flat) || std::abs(turn) > 2 * std::numbers::pi + flat) return Vector3d::Zero();
  return turn > 0 ? normal : Vector3d(-normal);
}

}  // namespace

Vector3d collapsed_side_normal(const SplineSurface& surface, const Points& columns, Coordinates coordinates,
                               const Place& place) {
  const Knots<double>&u = surface.u(), &v = surface.v();
  const KnotPlace<double> in_u{place.face % u.num_faces(), place.u}, in_v{place.face / u.num_faces(), place.v};
  const bool rational = coordinates == Coordinates::homogeneous;
  Vector3d normal = Vector3d::Zero();
  int sides = 0;
  const auto add = [&](const std::vector<Vector3d>& vectors, bool is_closed, double sign) {
    if (vectors.empty()) return;
    normal = sign * turning_normal(vectors, is_closed);
    ++sides;
  };
  const Direction along_u{u, in_u, 1}, along_v{v, in_v, u.num_points()};
  // du x dv = (v - v_0) T' x T for vectors T along u, and (u - u_0) T x T' for those along v.
  if (place.v == 0 || place.v == 1)
    add(vectors_at_point(columns, rational, along_v, along_u), u.is_closed(), place.v == 0 ? -1 : 1);
  if (place.u == 0 || place.u == 1)
    add(vectors_at_point(columns, rational, along_u, along_v), v.is_closed(), place.u == 0 ? 1 : -1);
  return sides == 1 ? normal : Vector3d::Zero();
}

}  // namespace sublimit
