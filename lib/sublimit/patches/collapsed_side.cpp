// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/collapsed_side.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "sublimit/core/dense_decompositions.h"
#include "sublimit/patches/spline_rows.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

/// Control vectors of the derivative across a side that is one point, along the side; empty if it is not.
/// @param across      the knots of the parameter that goes inwards, and the place on the side
/// @param stride      from a control point to the next across the side, and along it
std::vector<Vector3d> vectors_at_point(const Points& columns, bool rational, const Knots<double>& across,
                                       const KnotPlace<double>& place, Index stride_across, Index num_along,
                                       Index stride_along) {
  const PointRows rows = point_rows(across, place, 1);
  const auto sum = [&](int r, Index along) {
    Eigen::RowVector4d value(0, 0, 0, 0);
    for (size_t j = 0; j < rows.points.size(); ++j) {
      const Index point = rows.points[j] * stride_across + along * stride_along;
      value.head(columns.cols()) += rows.weights(r, Eigen::Index(j)) * columns.row(point);
      if (!rational && r == 0) value[3] += rows.weights(r, Eigen::Index(j));
    }
    return value;
  };
  Points ends(num_along, 4), inwards(num_along, 4);
  for (Index i = 0; i < num_along; ++i) ends.row(i) = sum(0, i), inwards.row(i) = sum(1, i);
  Eigen::Index heaviest = 0;
  ends.col(3).cwiseAbs().maxCoeff(&heaviest);
  if (ends(heaviest, 3) == 0) return {};
  const Eigen::RowVector3d point = ends.row(heaviest).head(3) / ends(heaviest, 3);
  const double noise = 64 * std::numeric_limits<double>::epsilon() * columns.cwiseAbs().maxCoeff();
  std::vector<Vector3d> vectors;
  for (Index i = 0; i < num_along; ++i) {
    if ((ends.row(i).head(3) - ends(i, 3) * point).norm() > noise) return {};
    const Vector3d vector = inwards.row(i).head(3) - inwards(i, 3) * point;
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
                               const Sample& sample) {
  const Knots<double>&u = surface.u(), &v = surface.v();
  const KnotPlace<double> in_u{sample.face % u.num_faces(), sample.u}, in_v{sample.face / u.num_faces(), sample.v};
  const bool rational = coordinates == Coordinates::homogeneous;
  Vector3d normal = Vector3d::Zero();
  int sides = 0;
  const auto add = [&](const std::vector<Vector3d>& vectors, bool is_closed, double sign) {
    if (vectors.empty()) return;
    normal = sign * turning_normal(vectors, is_closed);
    ++sides;
  };
  // du x dv = (v - v_0) T' x T for vectors T along u, and (u - u_0) T x T' for those along v.
  if (sample.v == 0 || sample.v == 1)
    add(vectors_at_point(columns, rational, v, in_v, u.num_points(), u.num_points(), 1), u.is_closed(),
        sample.v == 0 ? -1 : 1);
  if (sample.u == 0 || sample.u == 1)
    add(vectors_at_point(columns, rational, u, in_u, 1, v.num_points(), u.num_points()), v.is_closed(),
        sample.u == 0 ? 1 : -1);
  return sides == 1 ? normal : Vector3d::Zero();
}

}  // namespace sublimit
