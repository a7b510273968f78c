// SPDX-License-Identifier: Apache-2.0
#pragma once
// The part of a square or triangle that a search stays in: between bounds of u and v, and inside.
#include <Eigen/Core>

#include <array>

#include "sublimit/source/address.h"

namespace sublimit {

class SearchDomain {
 public:
  /// All of the square or triangle.
  explicit SearchDomain(bool triangle) : triangle_(triangle) {}
  /// Makes the part of the domain within `radius` of a place, in u and in v.
  SearchDomain(bool triangle, const Place& centre, double radius);

  bool triangle() const { return triangle_; }
  /// Sides 0 to 3: u from below, v from below, u from above, v from above; side 4 of triangles: u + v = 1.
  size_t num_sides() const { return triangle_ ? 5 : 4; }
  static const Eigen::Vector2d& normal(size_t side) { return normals[side]; }  ///< outward
  static const Eigen::Vector2d& along(size_t side) { return directions[side]; }
  /// How far inside a place is, by side; 0 on it.
  double inside(const Place& s, size_t side) const;

  /// The place t steps on, not beyond the first side in the way, and then on it: t is what was left of it. It has as
  /// few digits as the step allows: where a surface is no polynomial, every digit of a place costs a level.
  Place moved(const Place& s, const Eigen::Vector2d& step, double& t) const;
  /// A part of the way to the middle of the whole square or triangle.
  Place inwards(const Place& s, double part) const;
  /// The side of the whole square or triangle that a place is on; -1 inside and at corners.
  int border(const Place& s) const;

 private:
  static const std::array<Eigen::Vector2d, 5> normals, directions;
  bool triangle_;
  std::array<double, 4> bounds_{0, 0, 1, 1};
};

}  // namespace sublimit
