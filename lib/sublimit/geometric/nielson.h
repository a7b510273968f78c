// SPDX-License-Identifier: Apache-2.0
#pragma once
// The side-vertex interpolant of three points with normals. Nielson 1987, "A transfinite, visually continuous,
// triangular interpolant" (Farin, ed., Geometric Modeling: Algorithms and New Trends, SIAM); the curves are our own
// choice, edge cubics throughout (edge_cubic.h).
//
//   e(s)      the edge cubic of two corners j, k; N_e(s) its normal: (1-s) N_j + s N_k without its part along e'
//   G_i(b)    the edge cubic from corner i to the point e(s) with normal N_e(s), s = b_k/(b_j + b_k), at 1 - b_i
//   S         sum of beta_i G_i, beta_i = b_j b_k / (b_0 b_1 + b_1 b_2 + b_2 b_0)
//
// On the side opposite to corner i, S equals e and is tangent to the plane with normal N_e, which depends only
// on the edge: neighbours join G^1. At corner i, S is differentiable, its derivatives being the tangents of
// both edges, but second derivatives depend on the direction from which they are approached.
#include "sublimit/geometric/geometric_scheme.h"
#include "sublimit/geometric/normal_mesh.h"
#include "sublimit/geometric/normal_triangle.h"

namespace sublimit {

/// The patch of a triangle.
template <class T>
class NielsonPatch {
 public:
  /// @param normals  unit normals
  /// @pre  points differ, no normal is parallel to an edge
  NielsonPatch(const std::array<Eigen::Vector3<T>, 3>& points, const std::array<Eigen::Vector3<T>, 3>& normals)
      : corners_(points, normals) {}

  const TriangleCorners<T>& corners() const { return corners_; }

  /// Returns position, derivatives per unit of u and v, and normal at u, v >= 0, u + v <= 1.
  ///
  /// Status: `crease` on sides for order >= 1, since a neighbour has other derivatives; `unbounded_second` at
  /// corners for order 2; `undefined_normal` if first derivatives are parallel or do not exist; `pole`, without
  /// a position, if a curve inside has no tangent.
  /// @param order  highest derivative, 0 to 2
  /// @note  Exact up to rounding: eps of the longest edge, of second derivatives eps / r at the distance r of a corner.
  PatchPoint<T> at(const T& u, const T& v, int order = 2) const {
    const TrianglePlace<T> place(u, v);
    const int origin = place.nearest;
    if (place.corner >= 0) return at_corner(place, order);
    const std::array<Eigen::Vector3<T>, 3> x = corners_.seen_from(origin);
    Eigen::Vector3<Jet<T>> found;
    if (order > 0) {
      found = value(x, place.jets());
    } else {
      found = value(x, place.b).template cast<Jet<T>>();
    }
    const PatchPoint<T> point = patch_point(corners_, place, found, origin, order);
    return point.status == LimitStatus::pole && place.opposite >= 0 ? on_side(x, place, order) : point;
  }

 private:
  template <class N>
  Eigen::Vector3<N> value(const std::array<Eigen::Vector3<T>, 3>& x, const std::array<N, 3>& b) const {
    using Vector = Eigen::Vector3<N>;
    const N sum = b[0] * b[1] + b[1] * b[2] + b[2] * b[0];
    Vector S = Vector::Zero();
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const N rest = b[j] + b[k], to_j = b[j] / rest, to_k = b[k] / rest;
      const EdgeCubic<N> side = corners_.edge(x, j, k).template cast<N>();
      const Vector e = side.at(to_j, to_k), along = side.derivative(to_j, to_k);
      const Vector mean = corners_.normals[j].template cast<N>() * to_j + corners_.normals[k].template cast<N>() * to_k,
                   n = part_across<N>(mean, along);  // of any length
      const Vector from = x[i].template cast<N>(), normal = corners_.normals[i].template cast<N>();
      S += edge_cubic<N>(from, normal, e, n).at(b[i], rest) * (b[j] * b[k] / sum);
    }
    return S;
  }

  /// Returns the point at a corner, where the derivative is linear in the direction, and along edges that of
  /// the edge cubics.
  PatchPoint<T> at_corner(const TrianglePlace<T>& place, int order) const {
    const std::array<Eigen::Vector3<T>, 3>& tangent = corners_.tangent[place.corner];
    const Eigen::Vector3<T> du = tangent[1] - tangent[0], dv = tangent[2] - tangent[0];
    Eigen::Vector3<Jet<T>> x;
    for (int c = 0; c < 3; ++c) x[c] = Jet<T>(T(0), du[c], dv[c]);
    PatchPoint<T> point = patch_point(corners_, place, x, place.corner, order < 1 ? order : 1);
    if (order == 2 && point.status == LimitStatus::crease) point.status = LimitStatus::unbounded_second;
    return point;
  }

  /// Returns the point on a side where N_e does not exist: that of the edge cubic.
  PatchPoint<T> on_side(const std::array<Eigen::Vector3<T>, 3>& x, const TrianglePlace<T>& place, int order) const {
    const int j = (place.opposite + 1) % 3, k = (place.opposite + 2) % 3;
    PatchPoint<T> point;
    point.position = corners_.points[place.nearest] + corners_.edge(x, j, k).at(place.b[j], place.b[k]) * corners_.unit;
    if (order > 0) point.status = LimitStatus::undefined_normal;
    return point;
  }

  TriangleCorners<T> corners_;
};

/// Returns the scheme of surfaces with such a patch on each triangle.
GeometricNormalScheme nielson(const SchemeOptions& options);

}  // namespace sublimit
