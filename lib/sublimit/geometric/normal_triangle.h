// SPDX-License-Identifier: Apache-2.0
#pragma once
// Common parts of triangle patches through points with normals: corners with the tangents of their edge cubics,
// places, and points with derivatives. Corners 0, 1, 2 have the parameters (0,0), (1,0), (0,1).
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <limits>

#include "sublimit/geometric/edge_cubic.h"
#include "sublimit/geometric/parameter_jet.h"
#include "sublimit/source/limit_status.h"

namespace sublimit {

/// Three points with normals. Lengths are stored in units of a power of two near the length of the longest
/// edge, so that squares neither overflow nor underflow.
template <class T>
struct TriangleCorners {
  std::array<Eigen::Vector3<T>, 3> points;
  std::array<Eigen::Vector3<T>, 3> normals;                 ///< unit normals
  T unit;                                                   ///< the power of two
  std::array<std::array<Eigen::Vector3<T>, 3>, 3> tangent;  ///< [i][k]: at i, of the edge cubic from i to k

  /// @param normals  unit normals
  /// @pre  points differ, no normal is parallel to an edge
  TriangleCorners(const std::array<Eigen::Vector3<T>, 3>& points, const std::array<Eigen::Vector3<T>, 3>& normals)
      : points(points), normals(normals), unit(1) {
    using std::ilogb;
    using std::ldexp;
    T largest(0);
    for (int i = 0; i < 3; ++i) {
      const T size = (points[(i + 1) % 3] - points[i]).cwiseAbs().maxCoeff();
      if (size > largest) largest = size;
    }
    if (largest > T(0)) unit = ldexp(T(1), static_cast<int>(ilogb(largest)));
    for (int i = 0; i < 3; ++i) {
      const std::array<Eigen::Vector3<T>, 3> x = seen_from(i);
      for (int k = 0; k < 3; ++k)
        tangent[i][k] = i == k ? Eigen::Vector3<T>::Zero() : edge_tangent<T>(x[k], normals[i]);
    }
  }

  /// Returns the points relative to corner `origin`, in units.
  std::array<Eigen::Vector3<T>, 3> seen_from(int origin) const {
    std::array<Eigen::Vector3<T>, 3> x;
    for (int i = 0; i < 3; ++i) x[i] = (points[i] - points[origin]) / unit;
    return x;
  }
  /// Returns the edge cubic between two corners.
  /// @param x  result of `seen_from`
  EdgeCubic<T> edge(const std::array<Eigen::Vector3<T>, 3>& x, int from, int to) const {
    return {x[from], x[to], tangent[from][to], -tangent[to][from]};
  }
};

/// A place of a triangle in barycentric coordinates; those that are 0 up to rounding are set to 0.
template <class T>
struct TrianglePlace {
  std::array<T, 3> b;
  int nearest = 0;    ///< corner with the largest coordinate
  int corner = -1;    ///< the corner that the place is at; -1: none
  int opposite = -1;  ///< corner opposite to the side that the place is on; -1 inside and at corners

  TrianglePlace(const T& u, const T& v) : b{T(1) - u - v, u, v} {
    const T eps = std::numeric_limits<T>::epsilon();
    if (b[0] < eps) b[0] = T(0);
    for (int i = 0; i < 3; ++i) {
      if (b[i] > b[nearest]) nearest = i;
      if (b[i] == T(0)) opposite = i;
    }
    if (b[nearest] >= T(1) || (b[1] == T(0) && b[2] == T(0))) corner = nearest;
    if (corner >= 0) opposite = -1;
  }
  /// Returns the coordinates with their derivatives by u and v.
  std::array<Jet<T>, 3> jets() const {
    return {Jet<T>(b[0], T(-1), T(-1)), Jet<T>(b[1], T(1), T(0)), Jet<T>(b[2], T(0), T(1))};
  }
};

/// Position and derivatives at a place. Absent quantities are zero.
template <class T>
struct PatchPoint {
  using Vector = Eigen::Vector3<T>;
  LimitStatus status = LimitStatus::regular;
  int order = 0;  ///< highest derivative that exists, at most the requested one
  Vector position = Vector::Zero();
  Vector du = Vector::Zero(), dv = Vector::Zero();                          ///< order 1
  Vector duu = Vector::Zero(), duv = Vector::Zero(), dvv = Vector::Zero();  ///< order 2
  Vector normal = Vector::Zero();  ///< unit length, along du x dv; for requested orders >= 1
};

template <class T>
bool is_finite(const Eigen::Vector3<T>& x) {
  const Eigen::Vector3<T> zero = x - x;  // of infinities not 0
  return zero[0] == T(0) && zero[1] == T(0) && zero[2] == T(0);
}

/// Sets the normal of a point with first derivatives, or its status to `undefined_normal` if they are parallel.
template <class T>
void set_normal(PatchPoint<T>& point) {
  using std::sqrt;
  const auto length = [](const Eigen::Vector3<T>& x) {
    const T largest = x.cwiseAbs().maxCoeff();
    return largest > T(0) ? T(largest * T((x / largest).norm())) : T(0);
  };
  const T a = length(point.du), b = length(point.dv);
  if (a > T(0) && b > T(0)) {
    const Eigen::Vector3<T> cross = (point.du / a).cross(Eigen::Vector3<T>(point.dv / b));
    const T sine = cross.norm();
    if (sine > T(64) * std::numeric_limits<T>::epsilon()) {
      point.normal = cross / sine;
      return;
    }
  }
  point.status = LimitStatus::undefined_normal;
}

/// Returns the point of a patch from its position with derivatives. On sides the status is `crease`, since
/// derivatives are one-sided.
/// @param x      position relative to corner `origin`, in units
/// @param order  requested order of derivatives
template <class T>
PatchPoint<T> patch_point(const TriangleCorners<T>& corners, const TrianglePlace<T>& place,
                          const Eigen::Vector3<Jet<T>>& x, int origin, int order) {
  PatchPoint<T> point;
  const auto part = [&](T Jet<T>::*member) {
    return Eigen::Vector3<T>(x[0].*member * corners.unit, x[1].*member * corners.unit, x[2].*member * corners.unit);
  };
  const Eigen::Vector3<T> offset = part(&Jet<T>::value);
  if (place.corner >= 0) {
    point.position = corners.points[place.corner];
  } else if (is_finite(offset)) {
    point.position = corners.points[origin] + offset;
  } else {
    point.status = LimitStatus::pole;
    return point;
  }
  if (order == 0) return point;
  point.du = part(&Jet<T>::u);
  point.dv = part(&Jet<T>::v);
  if (!is_finite(point.du) || !is_finite(point.dv)) {
    point.du = point.dv = Eigen::Vector3<T>::Zero();
    point.status = LimitStatus::undefined_normal;
    return point;
  }
  point.order = 1;
  if (place.corner >= 0 || place.opposite >= 0) point.status = LimitStatus::crease;
  set_normal(point);
  if (order == 1) return point;
  point.duu = part(&Jet<T>::uu);
  point.duv = part(&Jet<T>::uv);
  point.dvv = part(&Jet<T>::vv);
  if (is_finite(point.duu) && is_finite(point.duv) && is_finite(point.dvv)) {
    point.order = 2;
  } else {
    point.duu = point.duv = point.dvv = Eigen::Vector3<T>::Zero();
    if (point.status != LimitStatus::undefined_normal) point.status = LimitStatus::unbounded_second;
  }
  return point;
}

}  // namespace sublimit
