// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/torus_carrier.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace sublimit {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

/// Where the chord's share in the tangent plane is less than this, the edge runs along the normal.
constexpr double no_direction = 1e-3;

/// Squares of misfits below this are rounding errors: they are not bent to, for they would grow by 1/edge in slopes and
/// 1/edge^2 in curvatures. They fade out smoothly.
constexpr double rounding2 = 1e-24;

/// The directions x and y at a frame, in its e1 and e2: along the chord, as long as the edge; and across. Along a
/// geodesic, which edges nearly are, they do not change but with the tangent plane: derivatives have no other terms,
/// and the coordinates of the torus piece, which may wind as they like where it is nearly flat, do not matter.
/// @return  columns x, y; zero where the edge has no direction
Matrix2d directions(const TorusPiece::Frame& frame, const Vector3d& chord, double length, double skew) {
  const Vector2d along(chord.dot(frame.e1), chord.dot(frame.e2));
  if (!(along.norm() > no_direction * chord.norm())) return Matrix2d::Zero();
  const Vector2d x = along.normalized() * length;
  Matrix2d result;
  result << x, skew * x + Vector2d(-x.y(), x.x());
  return result;
}

/// Length of an arc by that of its chord, for the sine of the angle between them.
double arc_by_chord(double sine) {
  const double x = std::min(1.0, std::abs(sine));
  return x == 0 ? 1 : std::asin(x) / x;
}

/// The second form of the offset surface in distance w, in the principal frame.
Matrix2d offset_shape(const TorusPiece::Frame& frame, double w) {
  return Vector2d(frame.k1 / (1 - w * frame.k1), frame.k2 / (1 - w * frame.k2)).asDiagonal();
}

}  // namespace

std::optional<TorusCarrier> TorusCarrier::make(const TorusPiece& piece, const SurfacePoint& far, double skew) {
  TorusCarrier carrier(piece);
  carrier.skew_ = skew;
  const TorusPiece::Coordinates foot = piece.foot(far.position);
  const TorusPiece::Frame near = piece.at(0, 0), frame = piece.at(foot.u, foot.v);
  carrier.chord_ = far.position - near.position;
  carrier.nearness_ = piece.nearness(foot);
  const double cosine = far.normal.dot(frame.n), w = foot.w;
  if (!(cosine > 0) || !std::isfinite(frame.k2)) return std::nullopt;
  // Slopes of the far surface over the plane at right angles to the piece's normal, and its second derivatives there.
  const Vector2d slope = -Vector2d(far.normal.dot(frame.e1), far.normal.dot(frame.e2)) / cosine;
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << frame.e1 + slope.x() * frame.n, frame.e2 + slope.y() * frame.n;
  const Matrix2d second = tangents.transpose() * far.shape() * tangents * std::sqrt(1 + slope.squaredNorm());
  const Vector2d gradient(slope.x() * (1 - w * frame.k1), slope.y() * (1 - w * frame.k2));
  const Matrix2d hessian = second - offset_shape(frame, w);

  const double h = carrier.chord_.norm();
  carrier.length_ =
      h / 2 * (arc_by_chord(carrier.chord_.dot(near.n) / h) + arc_by_chord(carrier.chord_.dot(frame.n) / h));
  const Matrix2d xy = directions(frame, carrier.chord_, carrier.length_, skew);
  carrier.misfit2_ = w / h * (w / h) + gradient.squaredNorm() + h * h * hessian.squaredNorm();
  const double share = carrier.misfit2_ / (carrier.misfit2_ + rounding2);
  const Vector2d first = share * xy.transpose() * gradient;
  const Matrix2d seconds = share * xy.transpose() * hessian * xy;
  carrier.value_ = share * w;
  carrier.along_ = first[0];
  carrier.across_ = first[1];
  carrier.along_along_ = seconds(0, 0);
  carrier.along_across_ = seconds(0, 1);
  carrier.across_across_ = seconds(1, 1);
  if (!std::isfinite(carrier.misfit2_)) return std::nullopt;
  return carrier;
}

std::optional<TorusCarrier::Middle> TorusCarrier::middle(const Vector3d& guess) const {
  const TorusPiece::Coordinates place = piece_.foot(guess);
  const TorusPiece::Frame frame = piece_.at(place.u, place.v);
  const Matrix2d xy = directions(frame, chord_, length_, skew_);
  if (xy.isZero(0) || !std::isfinite(frame.k2)) return std::nullopt;

  // The rule half way, everything being zero at x = 0.
  const double value = value_ / 2 - along_ * 3 / 20 + along_along_ / 80;
  const double along = value_ * 9 / 4 - along_ * 5 / 8 + along_along_ / 16;
  const double along_along = along_ * 3 / 2 - along_along_ / 4;
  const double across = across_ / 2 - along_across_ / 8;
  const double along_across = across_ * 2 - along_across_ / 2;
  const double across_across = across_across_ / 2;

  // Back to the principal frame.
  const Matrix2d inverse = xy.inverse();
  const Vector2d gradient = inverse.transpose() * Vector2d(along, across);
  Matrix2d second;
  second << along_along, along_across, along_across, across_across;
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
