// SPDX-License-Identifier: Apache-2.0
#pragma once
// Domains of searches: the part of a square or triangle between bounds of u and v.
#include <Eigen/Core>

#include <array>

#include "sublimit/source/address.h"

namespace sublimit {

/// A part of a square or triangle.
class SearchDomain {
 public:
  /// Makes the whole square or triangle.
  explicit SearchDomain(bool triangle) : triangle_(triangle) {}
  /// Makes the part of the domain within `radius` of a place, in u and in v.
  SearchDomain(bool triangle, const Place& centre, double radius);

  bool triangle() const { return triangle_; }
  /// Number of sides. Sides 0 to 3 are the lower bounds of u and v and the upper bounds of u and v; side 4 of
  /// triangles is u + v = 1.
  size_t num_sides() const { return triangle_ ? 5 : 4; }
  static const Eigen::Vector2d& normal(size_t side) { return normals[side]; }  ///< outward
  static const Eigen::Vector2d& along(size_t side) { return directions[side]; }
  /// Returns how far inside a side a place is; 0 on it.
  double inside(const Place& s, size_t side) const;

  /// Returns the place t steps further, or on the first side in the way; t is then reduced accordingly. The
  /// place is rounded to as few binary digits as the step allows, since evaluation of surfaces without
  /// polynomials costs a level per digit.
  Place moved(const Place& s, const Eigen::Vector2d& step, double& t) const;
  /// Returns the place a fraction `part` of the way to the middle of the whole square or triangle.
  Place inwards(const Place& s, double part) const;
  /// Returns the side of the whole square or triangle that a place is on; -1 inside and at corners.
  int border(const Place& s) const;

 private:
  static const std::array<Eigen::Vector2d, 5> normals, directions;
  bool triangle_;
  std::array<double, 4> bounds_{0, 0, 1, 1};
};

}  // namespace sublimit
