// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/plane_polygon.h"

#include <Eigen/Geometry>

#include <cmath>
#include <complex>
#include <numbers>

namespace sublimit {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixX3d;
using Eigen::Vector3d;

/// Tangents that span less than this part of what they could are none: the plane would be rounding.
constexpr double least_span = 1e-3;

/// The shortest way from one unit vector to another; half a turn about `axis`, which is perpendicular to `from`, first
/// if they are nearly opposite.
Matrix3d turn_between(Vector3d from, const Vector3d& to, const Vector3d& axis) {
  Matrix3d half = Matrix3d::Identity();
  if (from.dot(to) < -0.9) {
    half = 2 * axis * axis.transpose() - half;
    from = -from;
  }
  const Vector3d v = from.cross(to);
  const Matrix3d cross{{0, -v.z(), v.y()}, {v.z(), 0, -v.x()}, {-v.y(), v.x(), 0}};
  return (Matrix3d::Identity() + cross + cross * cross / (1 + from.dot(to))) * half;
}

/// Corners of a regular polygon across the normal, turned as those of the given one lie.
MatrixX3d regular_polygon(const MatrixX3d& corners, const Vector3d& normal, double radius) {
  const Vector3d e1 = normal.unitOrthogonal(), e2 = normal.cross(e1);
  const Eigen::Index n = corners.rows();
  const auto root = [&](Eigen::Index i) { return std::polar(1.0, 2 * std::numbers::pi * double(i) / double(n)); };
  std::complex<double> phase = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    phase += std::conj(root(i)) * std::complex<double>(corners.row(i).dot(e1), corners.row(i).dot(e2));
  phase = std::abs(phase) > least_span * radius ? phase / std::abs(phase) : 1.0;
  MatrixX3d result(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::complex<double> z = radius * phase * root(i);
    result.row(i) = z.real() * e1 + z.imag() * e2;
  }
  return result;
}

}  // namespace

OrientationResult turn_across(PlanePolygon& polygon, const Vector3d& normal, double scale) {
  const Vector3d N = normal.stableNormalized(), position = polygon.corners.transpose() * polygon.weights.col(0);
  MatrixX3d d = polygon.corners.rowwise() - position.transpose();
  const double radius = d.rowwise().norm().mean(), largest = polygon.corners.cwiseAbs().maxCoeff();
  if (radius <= 1e-12 * largest) return OrientationResult::impossible;
  const Vector3d t1 = d.transpose() * polygon.weights.col(1), t2 = d.transpose() * polygon.weights.col(2);
  const Vector3d across = t1.cross(t2);
  const auto reach = [&](int column) { return polygon.weights.col(column).cwiseAbs().dot(d.rowwise().norm()); };
  OrientationResult turn = OrientationResult::plain;
  if (across.norm() <= least_span * reach(1) * reach(2)) {
    turn = OrientationResult::rebuilt;
    d = regular_polygon(d, N, radius);
  } else {
    const Vector3d own = across.normalized();
    if (own.dot(N) < 0) turn = OrientationResult::over;
    d = (d * turn_between(own, N, t1.normalized()).transpose()).eval();
  }
  d *= scale;
  d -= (d * N * N.transpose()).eval();
  polygon.corners = d.rowwise() + position.transpose();
  return turn;
}

void move_to(PlanePolygon& polygon, const Vector3d& position) {
  const Vector3d now = polygon.corners.transpose() * polygon.weights.col(0);
  polygon.corners.rowwise() += (position - now).transpose();
}

}  // namespace sublimit
