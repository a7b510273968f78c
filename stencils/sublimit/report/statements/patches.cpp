// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/statements/patches.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sublimit/certificates/regularity/curve_joints.h"

namespace sublimit::report {
namespace {

using Vec = Eigen::Vector3d;  // homogeneous points of the plane

/// Values or first derivatives of the cubic Hermite functions at an end: of value and slope at 0, then at 1.
std::array<double, 4> hermite(double x, bool derivative) {
  if (derivative) return {6 * x * x - 6 * x, 3 * x * x - 4 * x + 1, 6 * x - 6 * x * x, 3 * x * x - 2 * x};
  return {(1 + 2 * x) * (1 - x) * (1 - x), x * (1 - x) * (1 - x), x * x * (3 - 2 * x), x * x * (x - 1)};
}

double lagrange(const std::array<double, 3>& nodes, int i, double x) {
  double product = 1;
  for (int j = 0; j < 3; ++j)
    if (j != i) product *= (x - nodes[j]) / (nodes[i] - nodes[j]);
  return product;
}

/// A quadratic Bezier curve of homogeneous points, as a point of the plane.
Eigen::Vector2d point(const std::array<Vec, 3>& points, double t) {
  const Vec x = (1 - t) * ((1 - t) * points[0] + t * points[1]) + t * ((1 - t) * points[1] + t * points[2]);
  return x.head<2>() / x[2];
}

}  // namespace

Finding joint_is_g2(double factor) {
  // The points of a(t), and of a(1 + factor t) by its polar form.
  const Eigen::Vector2d p0(0, 0), p1(1, 2), p2(3, 1);
  const auto polar = [&](double s, double t) -> Eigen::RowVector2d {
    return ((1 - s) * (1 - t) * p0 + ((1 - s) * t + s * (1 - t)) * p1 + s * t * p2).transpose();
  };
  const auto piece = [&](double from, double to) {
    Eigen::MatrixXd points(3, 2);
    points << polar(from, from), polar(from, to), polar(to, to);
    return points;
  };
  const CurveJoint joint = curve_joints({{piece(0, 1), piece(1, 1 + factor)}}).at(0);
  Finding f{fate(joint.g >= 2), "derivatives on both sides of a joint of a parabola with itself"};
  f.numbers["factor " + drawn(factor).dump()] = "G^" + std::to_string(joint.g);
  return f;
}

Finding continuity_needs_dependent_tangents() {
  Eigen::MatrixXd before(3, 2), after(3, 2);  // around a corner
  before << 0, 0, 1, 0, 2, 0;
  after << 2, 0, 2, 1, 3, 2;
  const CurveJoint joint = curve_joints({{before, after}}).at(0);
  const Eigen::RowVector2d last = 2 * (before.row(2) - before.row(1)), first = 2 * (after.row(1) - after.row(0));
  const double area = last[0] * first[1] - last[1] * first[0];
  Finding f{fate(joint.g < 0 || area == 0), "two quadratic Bezier curves with a common end point"};
  f.numbers["order of contact"] = "G^" + std::to_string(joint.g);
  f.numbers["area spanned by the tangent vectors"] = area;
  return f;
}

Finding only_linear_maps_commute() {
  Eigen::Matrix3d linear, affine, projective;
  linear << 2, 1, 0, -1, 1, 0, 0, 0, 1;
  affine << 2, 1, 3, -1, 1, 4, 0, 0, 1;
  projective << 2, 1, 3, -1, 1, 4, .25, .125, 1;
  const std::array<Vec, 3> points{Vec(0, 0, 1), Vec(1, 2, 1), Vec(3, 1, 1)};
  const auto commutes = [&](const Eigen::Matrix3d& map, bool rational) {
    std::array<Vec, 3> moved;
    for (size_t i = 0; i < 3; ++i) {
      moved[i] = map * points[i];
      if (!rational) moved[i] /= moved[i][2];  // a polynomial curve has no weights to keep
    }
    const Eigen::Vector2d x = point(points, .5);
    const Vec y = map * Vec(x[0], x[1], 1);
    constexpr double rounding = 1e-12;
    return (point(moved, .5) - y.head<2>() / y[2]).norm() < rounding;
  };
  Finding f;
  f.numbers["linear"] = commutes(linear, false);
  f.numbers["affine"] = commutes(affine, false);
  f.numbers["projective, polynomial curve"] = commutes(projective, false);
  f.numbers["projective, rational curve"] = commutes(projective, true);
  f.fate = fate(commutes(linear, false) && !commutes(affine, false) && !commutes(projective, true));
  f.computed = "a Bezier curve of moved points beside the moved curve, polynomial and rational";
  return f;
}

Finding lagrange_patch_interpolates(bool one_row_of_nodes) {
  const std::array<double, 3> u{0, 1, 3}, v{0, 2, 5};
  const auto data = [](int i, int j) { return 1 + i * i + 3 * j + 2 * i * j * j; };
  double most = 0;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const double y = one_row_of_nodes ? u[l] : v[l];
      double sum = 0;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) sum += data(i, j) * lagrange(u, i, u[k]) * lagrange(v, j, y);
      most = std::max(most, std::abs(sum - data(k, l)));
    }
  constexpr double rounding = 1e-9;
  Finding f{fate(most < rounding), "a biquadratic patch through nine points, nodes 0, 1, 3 and 0, 2, 5"};
  f.numbers["largest distance from the data"] = drawn(most < rounding ? 0 : most);
  return f;
}

Finding hermite_patch_approximates() {
  const Eigen::Matrix4d data{{1, 2, 5, -1}, {0, 3, 1, 2}, {4, -2, 3, 1}, {2, 1, 0, 6}};  // value, slope at 0; at 1
  double most = 0;
  for (const int x : {0, 1})
    for (const int y : {0, 1}) {
      const auto a = hermite(x, false), b = hermite(y, false);
      const double at =
          Eigen::Map<const Eigen::RowVector4d>(a.data()) * data * Eigen::Map<const Eigen::Vector4d>(b.data());
      most = std::max(most, std::abs(at - data(2 * x, 2 * y)));
    }
  Finding f{fate(most > 0), "a bicubic Hermite patch at its corners"};
  f.numbers["largest distance from the points of the corners"] = most;
  return f;
}

Finding twists_at_a_corner(int twists) {
  // Value, both slopes and mixed derivative at every corner, as functionals on u^i v^j.
  Eigen::Matrix<double, 16, 16> data;
  int row = 0;
  for (const int x : {0, 1})
    for (const int y : {0, 1})
      for (const int du : {0, 1})
        for (const int dv : {0, 1}) {
          for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) {
              const auto power = [](int base, int exponent, int derivative) {
                if (derivative == 0) return std::pow(base, exponent);
                return exponent == 0 ? 0.0 : exponent * std::pow(base, exponent - 1);
              };
              data(row, 4 * i + j) = power(x, i, du) * power(y, j, dv);
            }
          ++row;
        }
  const int rank = static_cast<int>(data.fullPivLu().rank());
  const int freedom = 16, others = 4 * 3;  // points and two tangents
  const bool determined = rank == freedom;
  Finding f{fate(determined && others + 4 * twists == freedom),
            "rank of all points, tangents and one twist at each corner on the 16 coefficients of bicubic patches"};
  f.numbers["rank"] = rank;
  f.numbers["vectors with that many twists"] = others + 4 * twists;
  return f;
}

}  // namespace sublimit::report
