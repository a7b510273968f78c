// SPDX-License-Identifier: Apache-2.0
#pragma once
// Three quartic Bezier triangles through three points with normals. Piper 1987, "Visually smooth interpolation with
// triangular Bezier patches" (Farin, ed., Geometric Modeling: Algorithms and New Trends, SIAM); Shirman, Sequin 1987,
// "Local surface interpolation with Bezier patches" (CAGD 4). Piece m lies between the corners m, m + 1 and the centre.
//
//   row 0    the edge cubic e (edge_cubic.h), raised to degree 4: q_0 .. q_4
//   row 1    r_0 = (corner + first points of both its edges)/3, which puts it into the plane there; r_3 likewise. The
//            derivative across, D(s) = 4 sum of B_m^3(s) (r_m - (q_m + q_{m+1})/2), is k(s) a(s) + h(s) e'(s) with
//            linear k, h, a and a = N x e' (unit length) at the ends (Chiyokura, Kimura 1983, "Design of
//            solids with free-form surfaces"): the tangent plane along the edge is spanned by e' and a, and
//            depends only on the edge
//   spokes   s_1 = r_0, s_2 = (s_1 + points r beside it of both pieces)/3: C^1 across
//   free     one point of each piece. Our rule: spokes are cubics, c - 4 s_1 + 6 s_2 - 4 s_3 + C = 0. With C^1,
//            C = mean of the s_3 and 3 s_3 = s_2 + inner points of both pieces, that leaves one solution.
//
// Neighbours join G^1, pieces C^1. The surface is polynomial, but approximates round surfaces less well than
// nielson.h.
#include "sublimit/geometric/geometric_scheme.h"
#include "sublimit/geometric/normal_mesh.h"
#include "sublimit/geometric/normal_triangle.h"

namespace sublimit {

/// Returns the index of control point (j, k) of a quartic Bezier triangle: j fastest, then k. The point belongs
/// to the powers (4 - j - k, j, k) of the barycentric coordinates.
constexpr int quartic_index(int j, int k) { return 5 * k - k * (k - 1) / 2 + j; }

/// The patch of a triangle.
template <class T>
class PiperPatch {
 public:
  using Net = std::array<Eigen::Vector3<T>, 15>;

  /// @param normals  unit normals
  /// @pre  points differ, no normal is parallel to an edge
  PiperPatch(const std::array<Eigen::Vector3<T>, 3>& points, const std::array<Eigen::Vector3<T>, 3>& normals)
      : corners_(points, normals) {
    const std::array<Eigen::Vector3<T>, 3> x = corners_.seen_from(0);
    for (int m = 0; m < 3; ++m) set_side(x, m);
    set_inner(x);
  }

  const TriangleCorners<T>& corners() const { return corners_; }

  /// Returns the control points of the three pieces, indexed by `quartic_index`. Corners 0, 1, 2 of piece m are
  /// corners m and m + 1 of the triangle and its centre u = v = 1/3.
  std::array<Net, 3> control_points() const {
    std::array<Net, 3> nets = nets_;
    for (int m = 0; m < 3; ++m)
      for (Eigen::Vector3<T>& p : nets[m]) p = corners_.points[0] + p * corners_.unit;
    for (int m = 0; m < 3; ++m)
      for (const int end : {0, 1}) nets[m][quartic_index(4 * end, 0)] = corners_.points[(m + end) % 3];
    return nets;
  }

  /// Returns position, derivatives per unit of u and v, and normal at u, v >= 0, u + v <= 1.
  ///
  /// Status: `crease` on sides for order >= 1, since a neighbour has other derivatives, and on spokes for order
  /// 2, since second derivatives are those of one piece. Not at the centre, where three pieces that join C^1
  /// have common second derivatives too. `undefined_normal` if first derivatives are parallel.
  /// @param order  highest derivative, 0 to 2
  PatchPoint<T> at(const T& u, const T& v, int order = 2) const {
    const TrianglePlace<T> place(u, v);
    int least = 0;  // the corner that the piece does not have
    for (int i = 1; i < 3; ++i)
      if (place.b[i] < place.b[least]) least = i;
    const int m = (least + 1) % 3, other = (least + 2) % 3;
    Eigen::Vector3<Jet<T>> found;
    if (order > 0) {
      found = value(nets_[m], place.jets(), m, other, least);
    } else {
      found = value(nets_[m], place.b, m, other, least).template cast<Jet<T>>();
    }
    PatchPoint<T> point = patch_point(corners_, place, found, 0, order);
    const T next = (place.b[m] < place.b[other] ? place.b[m] : place.b[other]) - place.b[least],
            most = place.b[place.nearest] - place.b[least], rounding = T(4) * std::numeric_limits<T>::epsilon();
    if (next <= rounding && most > rounding && order == 2 && point.status == LimitStatus::regular)
      point.status = LimitStatus::crease;
    return point;
  }

 private:
  template <class N>
  static Eigen::Vector3<N> value(const Net& net, const std::array<N, 3>& b, int m, int other, int least) {
    const N x = b[m] - b[least], y = b[other] - b[least], z = N(3) * b[least];
    std::array<Eigen::Vector3<N>, 15> p;
    for (int i = 0; i < 15; ++i) p[i] = net[i].template cast<N>();
    for (int degree = 3; degree >= 0; --degree)  // de Casteljau
      for (int k = 0; k <= degree; ++k)
        for (int j = 0; j <= degree - k; ++j)
          p[quartic_index(j, k)] =
              p[quartic_index(j, k)] * x + p[quartic_index(j + 1, k)] * y + p[quartic_index(j, k + 1)] * z;
    return p[0];
  }

  /// Sets rows 0 and 1 of the piece at an edge.
  void set_side(const std::array<Eigen::Vector3<T>, 3>& x, int m) {
    using Vector = Eigen::Vector3<T>;
    const int n = (m + 1) % 3, o = (m + 2) % 3;
    Net& net = nets_[m];
    const std::array<Vector, 4> c = corners_.edge(x, m, n).control_points();
    for (int j = 0; j <= 4; ++j) {  // c(-1) and c(4) have weight 0
      Vector& q = net[quartic_index(j, 0)];
      q = j == 0 ? c[0] : j == 4 ? c[3] : Vector((c[j - 1] * T(j) + c[j] * T(4 - j)) / T(4));
    }
    // First point of a quartic edge: the corner and a quarter of the tangent.
    net[quartic_index(0, 1)] = x[m] + (corners_.tangent[m][n] + corners_.tangent[m][o]) / T(12);
    net[quartic_index(3, 1)] = x[n] + (corners_.tangent[n][m] + corners_.tangent[n][o]) / T(12);

    const auto middle = [&](int j) { return Vector((net[quartic_index(j, 0)] + net[quartic_index(j + 1, 0)]) / T(2)); };
    const std::array<Vector, 3> e{(c[1] - c[0]) * T(3), (c[2] - c[1]) * T(3), (c[3] - c[2]) * T(3)};  // of e'
    std::array<Vector, 2> a;
    std::array<T, 2> along, across;  // h, k
    for (const int end : {0, 1}) {
      const Vector D = (net[quartic_index(3 * end, 1)] - middle(3 * end)) * T(4), &tangent = e[2 * end];
      a[end] = corners_.normals[end == 0 ? m : n].cross(tangent);
      a[end] /= a[end].norm();
      along[end] = D.dot(tangent) / tangent.dot(tangent);
      across[end] = D.dot(a[end]);
    }
    // Bernstein coefficients 1 and 2 of k a + h e'.
    const Vector twist = (a[1] * across[0] + a[0] * across[1]) / T(2);
    for (const int end : {0, 1}) {
      const Vector bend = (a[end] * across[end] + twist * T(2)) / T(3);
      const Vector D = bend + (e[1] * along[end] * T(2) + e[2 * end] * along[1 - end]) / T(3);
      net[quartic_index(1 + end, 1)] = D / T(4) + middle(1 + end);
    }
  }

  /// Sets the remaining points: spokes, inner points and the centre.
  void set_inner(const std::array<Eigen::Vector3<T>, 3>& x) {
    using Vector = Eigen::Vector3<T>;
    std::array<Vector, 3> s1, s2, s3, sum;  // by corner
    Vector centre = Vector::Zero();
    for (int i = 0; i < 3; ++i) {
      const int before = (i + 2) % 3;  // the piece on the other side of the spoke
      s1[i] = nets_[i][quartic_index(0, 1)];
      s2[i] = (s1[i] + nets_[i][quartic_index(1, 1)] + nets_[before][quartic_index(2, 1)]) / T(3);
      s3[i] = (x[i] - s1[i] * T(4) + s2[i] * T(6)) / T(4);
      centre += s3[i] * T(4) / T(9);
    }
    for (int i = 0; i < 3; ++i) {
      s3[i] += centre / T(4);
      sum[i] = s3[i] * T(3) - s2[i];  // of the inner points of pieces i and before
    }
    for (int m = 0; m < 3; ++m) {
      const int n = (m + 1) % 3, o = (m + 2) % 3;
      Net& net = nets_[m];
      net[quartic_index(0, 2)] = s2[m];
      net[quartic_index(1, 2)] = (sum[m] + sum[n] - sum[o]) / T(2);
      net[quartic_index(2, 2)] = s2[n];
      net[quartic_index(0, 3)] = s3[m];
      net[quartic_index(1, 3)] = s3[n];
      net[quartic_index(0, 4)] = centre;
    }
  }

  TriangleCorners<T> corners_;
  std::array<Net, 3> nets_;  ///< relative to corner 0, in units
};

/// Returns the scheme of surfaces with such a patch on each triangle.
GeometricNormalScheme piper(const SchemeOptions& options);

}  // namespace sublimit
