// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/circular_arc.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sublimit {
namespace {

using Eigen::Vector3d;

/// The direction of the arc's middle. Short arcs take it from the tangents, where a chord would have rounding errors
/// of the size of coordinates over its length; long ones from the chord, where the sum of the tangents vanishes.
Vector3d middle_tangent(const Vector3d& s, const Vector3d& t, const Vector3d& chord, double width) {
  const Vector3d sum = s + t;
  if (width == 0 || sum.dot(chord) > width) return sum.stableNormalized();
  return chord / width;
}

}  // namespace

CircularArc::CircularArc(const HermitePoint& a, const HermitePoint& b)
    : a_(a),
      b_(b),
      chord_(b.position - a.position),
      rise_((a.tangent - b.tangent) / 2),
      width_(chord_.stableNorm()),
      sine_(std::min(1.0, rise_.stableNorm())) {
  const double cosine = width_ > 0 ? (a.tangent + b.tangent).dot(chord_ / width_) / 2 : 1;
  half_turn_ = std::atan2(sine_, cosine);
}

double CircularArc::share(double x) const { return straight() ? x : std::sin(x * half_turn_) / std::sin(half_turn_); }

HermitePoint CircularArc::at(double x) const {
  if (x == 0) return a_;
  if (x == 1) return b_;
  // Along the chord from its middle, and across by the product of the two shares.
  const double eta = 2 * x - 1, along = share(eta);
  const Vector3d position = a_.position + (1 + along) / 2 * chord_ + width_ * share(x) * share(1 - x) * rise_;
  const Vector3d tangent =
      std::cos(eta * half_turn_) * middle_tangent(a_.tangent, b_.tangent, chord_, width_) - along * rise_;
  return {position, tangent.normalized()};
}

double CircularArc::curvature() const {
  if (straight() || width_ == 0) return 0;
  const double magnitude = 2 * std::sin(half_turn_) / width_;
  const bool plane = chord_.z() == 0 && rise_.z() == 0;
  return plane && rise_.cross(chord_).z() < 0 ? -magnitude : magnitude;
}

Vector3d CircularArc::curvature_vector(double x) const {
  if (straight() || width_ == 0) return Vector3d::Zero();
  const double angle = (2 * x - 1) * half_turn_, sine = std::sin(half_turn_);
  const Vector3d middle = middle_tangent(a_.tangent, b_.tangent, chord_, width_);
  return -2 / width_ * (sine * std::sin(angle) * middle + std::cos(angle) * rise_);
}

double CircularArc::length() const { return straight() ? width_ : width_ * half_turn_ / std::sin(half_turn_); }

double CircularArc::radius() const {
  return straight() ? std::numeric_limits<double>::infinity() : width_ / (2 * std::sin(half_turn_));
}

Vector3d CircularArc::centre() const {
  return a_.position + chord_ / 2 - rise_ * (radius() * std::cos(half_turn_) / std::sin(half_turn_));
}

HermitePoint middle_of_arc(const HermitePoint& a, const HermitePoint& b) {
  const Vector3d chord = b.position - a.position, sum = a.tangent + b.tangent;
  const double width = chord.stableNorm();
  const Vector3d rise = (a.tangent - b.tangent) / 2;
  const double cosine = width > 0 ? sum.dot(chord / width) / 2 : 1;
  // 1/(1 + cosine); almost whole circles would lose digits in the sum.
  const double inverse = cosine < 0 ? (1 - cosine) / rise.squaredNorm() : 1 / (1 + cosine);
  return {a.position + chord / 2 + rise * (width / 2 * inverse), middle_tangent(a.tangent, b.tangent, chord, width)};
}

}  // namespace sublimit
