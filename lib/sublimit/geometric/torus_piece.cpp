// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/torus_piece.h"

#include <Eigen/Geometry>

#include <cmath>

namespace sublimit {

using Eigen::Vector3d;

namespace {

/// A circle of curvature k through (0, 0) along the first axis, bending to the second: the length of arc to the foot of
/// a point, and the point's distance from the circle, inwards.
struct Unrolled {
  double length, depth;
};
Unrolled unroll(double k, double along, double up) {
  const double cosine = 1 - k * up, sine = k * along;
  const double length = k == 0 ? along : std::atan2(sine, cosine) / k;
  // 1/k - sqrt((1/k - up)^2 + along^2), without the differences of large numbers.
  return {length, (2 * up - k * (along * along + up * up)) / (1 + std::hypot(cosine, sine))};
}

}  // namespace

TorusPiece::TorusPiece(const Vector3d& origin, const Vector3d& e1, const Vector3d& n, double k1, double k2, double g)
    : origin_(origin), e1_(e1), e2_(n.cross(e1)), n_(n), k1_(k1), k2_(k2), g_(g), kappa_(k2 * n + g * e1) {
  curvature_ = std::hypot(k2, g);
  const double along_n = curvature_ > 0 ? k2 / curvature_ : 1, along_e1 = curvature_ > 0 ? g / curvature_ : 0;
  towards_ = along_n * n + along_e1 * e1;
  axis_ = along_n * e1 - along_e1 * n;
}

TorusPiece::Frame TorusPiece::at(double u, double v) const {
  const double psi = k1_ * u, theta = curvature_ * v;
  const double half = sinc(psi / 2) * u, along = sinc(psi) * u, up = k1_ * half * half / 2;
  const Vector3d tube = along * e1_ + up * n_;
  Frame frame;
  frame.e1 = std::cos(psi) * e1_ + std::sin(psi) * n_;
  frame.n = std::cos(psi) * n_ - std::sin(psi) * e1_;
  frame.speed = 1 - kappa_.dot(tube);
  // The normal curvature kappa.n / speed; kappa.n = k1 speed + (k2 - k1) leaves spheres no quotient of small numbers.
  frame.k1 = k1_;
  frame.k2 = k2_ == k1_ ? k1_ : k1_ + (k2_ - k1_) / frame.speed;
  // The motion: the point goes round its circle, vectors turn about the axis.
  const double half_v = sinc(theta / 2) * v;
  frame.position = origin_ + tube + frame.speed * (sinc(theta) * v * e2_ + (half_v * half_v / 2) * kappa_);
  const double sine = std::sin(theta), versine = 2 * std::sin(theta / 2) * std::sin(theta / 2);
  const auto turned = [&](const Vector3d& x) -> Vector3d {
    return x - x.dot(towards_) * (versine * towards_ + sine * e2_);
  };
  frame.e1 = turned(frame.e1);
  frame.n = turned(frame.n);
  frame.e2 = frame.n.cross(frame.e1);
  return frame;
}

TorusPiece::Coordinates TorusPiece::foot(const Vector3d& x) const {
  const Vector3d d = x - origin_;
  const Unrolled around = unroll(curvature_, d.dot(e2_), d.dot(towards_));
  const Vector3d turned_back = around.depth * towards_ + d.dot(axis_) * axis_;
  const Unrolled tube = unroll(k1_, turned_back.dot(e1_), turned_back.dot(n_));
  return {tube.length, around.length, tube.depth};
}

double TorusPiece::nearness(const Coordinates& place) const {
  return (1 + std::cos(k1_ * place.u)) * (1 + std::cos(curvature_ * place.v)) / 4;
}

}  // namespace sublimit
