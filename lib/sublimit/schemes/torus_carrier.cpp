// SPDX-License-Identifier: Apache-2.0
#include "sublimit/schemes/torus_carrier.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace sublimit {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

/// An edge is shorter than this share of itself on the torus piece: it runs along the normal there.
constexpr double no_direction = 1e-3;

/// The edge on the torus piece, u = u1 x and v = v1 x, in the principal frame: velocity and (covariant) acceleration.
struct Motion {
  Vector2d velocity, acceleration;
  double skew;
  /// The direction y, and its (covariant) derivative by x.
  Vector2d across() const { return across(velocity); }
  Vector2d across_change() const { return across(acceleration); }
  Vector2d across(const Vector2d& a) const { return {skew * a.x() - a.y(), skew * a.y() + a.x()}; }
};
Motion motion(const TorusPiece::Frame& frame, double u1, double v1, double skew) {
  return {{u1, frame.speed * v1}, {-frame.speed * frame.speed_slope * v1 * v1, 2 * frame.speed_slope * u1 * v1}, skew};
}

/// The second form of the offset surface in distance w, in the principal frame.
Matrix2d offset_shape(const TorusPiece::Frame& frame, double w) {
  return Vector2d(frame.k1 / (1 - w * frame.k1), frame.k2 / (1 - w * frame.k2)).asDiagonal();
}

}  // namespace

std::optional<TorusCarrier> TorusCarrier::make(const TorusPiece& piece, const SurfacePoint& far, double skew) {
  TorusCarrier carrier(piece);
  carrier.skew_ = skew;
  carrier.far_ = piece.foot(far.position);
  const TorusPiece::Frame frame = piece.at(carrier.far_.u, carrier.far_.v);
  carrier.length_ = (far.position - piece.at(0, 0).position).norm();
  const double cosine = far.normal.dot(frame.n), w = carrier.far_.w;
  if (!(cosine > 0) || !std::isfinite(frame.k2)) return std::nullopt;
  // Slopes of the far surface over the plane at right angles to the piece's normal, and its second derivatives there.
  const Vector2d slope = -Vector2d(far.normal.dot(frame.e1), far.normal.dot(frame.e2)) / cosine;
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << frame.e1 + slope.x() * frame.n, frame.e2 + slope.y() * frame.n;
  const Matrix2d second = tangents.transpose() * far.shape() * tangents * std::sqrt(1 + slope.squaredNorm());
  const Vector2d gradient(slope.x() * (1 - w * frame.k1), slope.y() * (1 - w * frame.k2));
  const Matrix2d hessian = second - offset_shape(frame, w);

  const Motion m = motion(frame, carrier.far_.u, carrier.far_.v, skew);
  const Vector2d c = m.across();
  carrier.value_ = w;
  carrier.along_ = gradient.dot(m.velocity);
  carrier.across_ = gradient.dot(c);
  carrier.along_along_ = m.velocity.dot(hessian * m.velocity) + gradient.dot(m.acceleration);
  carrier.along_across_ = m.velocity.dot(hessian * c) + gradient.dot(m.across_change());
  carrier.across_across_ = c.dot(hessian * c);

  const double h = carrier.length_;
  carrier.misfit2_ = w / h * (w / h) + slope.squaredNorm() + h * h * hessian.squaredNorm();
  if (!std::isfinite(carrier.misfit2_)) return std::nullopt;
  return carrier;
}

std::optional<TorusCarrier::Middle> TorusCarrier::middle(const Vector3d& guess) const {
  const TorusPiece::Place place = piece_.foot(guess);
  const TorusPiece::Frame frame = piece_.at(place.u, place.v);
  const Motion m = motion(frame, far_.u, far_.v, skew_);
  const double d2 = m.velocity.squaredNorm();
  if (!(d2 > no_direction * no_direction * length_ * length_) || !std::isfinite(frame.k2)) return std::nullopt;

  // The rule half way, everything being zero at x = 0.
  const double value = value_ / 2 - along_ * 3 / 20 + along_along_ / 80;
  const double along = value_ * 9 / 4 - along_ * 5 / 8 + along_along_ / 16;
  const double along_along = along_ * 3 / 2 - along_along_ / 4;
  const double across = across_ / 2 - along_across_ / 8;
  const double along_across = across_ * 2 - along_across_ / 2;
  const double across_across = across_across_ / 2;

  // Back to the principal frame.
  Matrix2d directions;
  directions << m.velocity, m.across();
  const Matrix2d inverse = directions.inverse();
  const Vector2d gradient = inverse.transpose() * Vector2d(along, across);
  Matrix2d second;
  second(0, 0) = along_along - gradient.dot(m.acceleration);
  second(0, 1) = second(1, 0) = along_across - gradient.dot(m.across_change());
  second(1, 1) = across_across;
  const Matrix2d hessian = inverse.transpose() * second * inverse + offset_shape(frame, value);

  Middle middle;
  const Vector2d slope(gradient.x() / (1 - value * frame.k1), gradient.y() / (1 - value * frame.k2));
  middle.position = frame.position + value * frame.n;
  middle.normal = (frame.n - slope.x() * frame.e1 - slope.y() * frame.e2).normalized();
  // The dual basis of the tangents e + slope n is e, projected to the tangent plane.
  Eigen::Matrix<double, 3, 2> dual;
  dual << frame.e1 - frame.e1.dot(middle.normal) * middle.normal,
      frame.e2 - frame.e2.dot(middle.normal) * middle.normal;
  middle.shape = dual * hessian * dual.transpose() / std::sqrt(1 + slope.squaredNorm());
  middle.distance = place.w;
  if (!middle.position.allFinite() || !middle.shape.allFinite()) return std::nullopt;
  return middle;
}

}  // namespace sublimit
