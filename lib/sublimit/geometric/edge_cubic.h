// SPDX-License-Identifier: Apache-2.0
#pragma once
// The edge cubic: a curve between two points with normals. It depends on nothing else, so that the surfaces on
// both sides of an edge have the same boundary. The tangent at an end is the projection t of the chord D to the
// plane there, with the length 2 |D|^2 / (|t| + |D|): that of the Hermite cubic which best follows a circular
// arc (of angle alpha between its ends: 4 tan(alpha/4) of the radius), so that circles are approximated to
// 2.7e-4 of their radius at 90 degrees.
//
// Everything is generic in the number type: double, 256-bit floats, jets (jet.h) of either.
#include <Eigen/Core>

#include <array>
#include <cmath>
#include <limits>

#include "sublimit/geometric/parameter_jet.h"

namespace sublimit {

/// Cubic curve from a to b. Its parameter t from 0 to 1 is given by `to_b` = t and `to_a` = 1 - t, since
/// computing the smaller one as a difference would lose digits near an end.
template <class T>
struct EdgeCubic {
  Eigen::Vector3<T> a, b;                  ///< ends
  Eigen::Vector3<T> tangent_a, tangent_b;  ///< derivatives by t there

  Eigen::Vector3<T> at(const T& to_a, const T& to_b) const {
    const T aa = to_a * to_a, bb = to_b * to_b, three(3);
    return a * (aa * (to_a + three * to_b)) + tangent_a * (aa * to_b) - tangent_b * (bb * to_a) +
           b * (bb * (to_b + three * to_a));
  }
  Eigen::Vector3<T> derivative(const T& to_a, const T& to_b) const {
    const T two(2);
    return (b - a) * (T(6) * to_a * to_b) + tangent_a * (to_a * (to_a - two * to_b)) +
           tangent_b * (to_b * (to_b - two * to_a));
  }
  /// Returns the Bezier points.
  std::array<Eigen::Vector3<T>, 4> control_points() const {
    const T three(3);
    return {a, a + tangent_a / three, b - tangent_b / three, b};
  }
  template <class N>
  EdgeCubic<N> cast() const {
    return {a.template cast<N>(), b.template cast<N>(), tangent_a.template cast<N>(), tangent_b.template cast<N>()};
  }
};

/// Returns x without its component along `direction`; 0 if the rest is rounding.
template <class T>
Eigen::Vector3<T> part_across(const Eigen::Vector3<T>& x, const Eigen::Vector3<T>& direction) {
  const Eigen::Vector3<T> rest = x - direction * (x.dot(direction) / direction.dot(direction));
  const auto size2 = value_of(x.dot(x)), rest2 = value_of(rest.dot(rest));
  const decltype(size2) rounding = 64 * std::numeric_limits<std::decay_t<decltype(size2)>>::epsilon();
  if (rest2 > size2 * (rounding * rounding)) return rest;
  return Eigen::Vector3<T>::Zero();
}

/// Returns the derivative of the edge cubic at an end.
/// @param chord   vector to the other end, or from it; the tangent points along it
/// @param normal  of any length > 0, on any side
/// @return  not finite if the chord runs along the normal or has length 0
template <class T>
Eigen::Vector3<T> edge_tangent(const Eigen::Vector3<T>& chord, const Eigen::Vector3<T>& normal) {
  using std::sqrt;
  const Eigen::Vector3<T> along = part_across<T>(chord, normal);
  const T chord2 = chord.dot(chord), length = sqrt(along.dot(along));
  return along * (T(2) * chord2 / (length * (length + sqrt(chord2))));
}

/// Returns the edge cubic of two points with normals.
template <class T>
EdgeCubic<T> edge_cubic(const Eigen::Vector3<T>& a, const Eigen::Vector3<T>& normal_a, const Eigen::Vector3<T>& b,
                        const Eigen::Vector3<T>& normal_b) {
  const Eigen::Vector3<T> chord = b - a;
  return {a, b, edge_tangent<T>(chord, normal_a), edge_tangent<T>(chord, normal_b)};
}

}  // namespace sublimit
