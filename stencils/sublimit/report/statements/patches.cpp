// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/statements/patches.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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

Finding joint_is_g1(double factor) {
  const Eigen::Vector2d before(3, 1), after = factor * before;
  const double cross = before[0] * after[1] - before[1] * after[0];
  const double degrees = std::atan2(std::abs(cross), before.dot(after)) * 180 / std::numbers::pi;
  Finding f{fate(degrees == 0), "the angle between the directions in which the curve arrives and leaves"};
  f.numbers["factor"] = factor;
  f.numbers["angle in degrees"] = drawn(degrees);
  return f;
}

Finding continuity_needs_dependent_tangents() {
  // Control polygons of two quadratic curves, one around a corner from the other.
  const std::array<Vec, 3> a{Vec(0, 0, 1), Vec(1, 0, 1), Vec(2, 0, 1)}, b{Vec(2, 0, 1), Vec(2, 1, 1), Vec(3, 2, 1)};
  const Eigen::Vector2d last = 2 * (a[2] - a[1]).head<2>(), first = 2 * (b[1] - b[0]).head<2>();
  const double gap = (point(a, 1) - point(b, 0)).norm(), area = last[0] * first[1] - last[1] * first[0];
  Finding f{fate(gap > 0 || area == 0), "two quadratic Bezier curves with a common end point, by de Casteljau"};
  f.numbers["gap"] = gap;
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
