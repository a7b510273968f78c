// SPDX-License-Identifier: Apache-2.0
#include "lib/geometric/torus_patch.h"

#include <Eigen/Geometry>

#include <cmath>

namespace sublimit::testing {

using Eigen::Vector3d;

namespace {

/// (1 - cos(k s))/k^2
double versine(double k, double s) { return s * s / 2 * sinc(k * s / 2) * sinc(k * s / 2); }

std::array<double, 3> bernstein(double x) { return {(1 - x) * (1 - x), 2 * x * (1 - x), x * x}; }

}  // namespace

Vector3d RationalPatch::at(double s, double t) const {
  const std::array<double, 3> a = bernstein(s), b = bernstein(t);
  Vector3d sum = Vector3d::Zero();
  double weight = 0;
  for (size_t i = 0; i < 9; ++i) {
    const double w = weights[i] * a[i % 3] * b[i / 3];
    sum += w * points[i];
    weight += w;
  }
  return sum / weight;
}

RationalPatch torus_patch(const TorusPiece& piece, const TorusPiece::Coordinates& centre, double half_u,
                          double half_v) {
  const TorusPiece::Frame at = piece.at(centre.u, centre.v), origin = piece.at(0, centre.v);
  const Vector3d kappa = origin.k2 * origin.n + piece.geodesic() * origin.e1;
  const double k = at.k1, curvature = kappa.norm();
  const double cos_u = std::cos(k * half_u), cos_v = std::cos(curvature * half_v);
  const double rise_u = k * versine(k, half_u), along = sinc(k * half_u) * half_u;
  const std::array<Vector3d, 3> tube{at.position - along * at.e1 + rise_u * at.n, at.position - rise_u / cos_u * at.n,
                                     at.position + along * at.e1 + rise_u * at.n};
  const std::array<double, 3> tube_weights{1, cos_u, 1}, around_weights{1, cos_v, 1};
  RationalPatch patch;
  for (size_t j = 0; j < 3; ++j)
    for (size_t i = 0; i < 3; ++i) {
      // The motion moves a point the slower the nearer it is to the axis.
      const double speed = 1 - kappa.dot(tube[i] - origin.position), to_side = static_cast<double>(j) - 1;
      const Vector3d inwards = speed * versine(curvature, half_v) * kappa;
      const Vector3d sideways = speed * to_side * sinc(curvature * half_v) * half_v * at.e2;
      patch.points[3 * j + i] = j == 1 ? Vector3d(tube[i] - inwards / cos_v) : Vector3d(tube[i] + sideways + inwards);
      patch.weights[3 * j + i] = tube_weights[i] * around_weights[j];
    }
  return patch;
}

}  // namespace sublimit::testing
