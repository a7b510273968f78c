// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points with normals for triangle patches, on spheres and at random near a plane, and the laws that every such
// patch obeys.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "sublimit/geometric/normal_triangle.h"
#include "truth/precise.h"

namespace sublimit::testing {

template <class T>
struct CornerData {
  Eigen::Vector3<T> point, normal;

  template <class N>
  CornerData<N> cast() const {  // normals of length 1 to the last digit of N
    const Eigen::Vector3<N> n = normal.template cast<N>();
    return {point.template cast<N>(), n / n.norm()};
  }
};
template <class T>
using TriangleData = std::array<CornerData<T>, 3>;

/// Returns four corners with coordinates of about 1 and normals within some 40 degrees of z. Triangles (0, 1,
/// 2) and (0, 3, 1) share an edge.
inline std::array<CornerData<double>, 4> random_corners(unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&](double size) { return size * (std::ldexp(double(random()), -31) - 1); };
  const std::array<Eigen::Vector2d, 4> plane{Eigen::Vector2d(0, 0), {1, 0.1}, {0.4, 0.9}, {0.5, -0.8}};
  std::array<CornerData<double>, 4> corners;
  for (size_t i = 0; i < 4; ++i) {
    corners[i].point = {plane[i].x() + number(0.2), plane[i].y() + number(0.2), number(0.2)};
    corners[i].normal = Eigen::Vector3d(number(0.6), number(0.6), 1).normalized();
  }
  return corners;
}

template <template <class> class Patch, class T>
Patch<T> patch_of(const TriangleData<T>& data) {
  return {{data[0].point, data[1].point, data[2].point}, {data[0].normal, data[1].normal, data[2].normal}};
}

template <class T>
TriangleData<T> triangle(const std::array<CornerData<double>, 4>& corners, std::array<size_t, 3> which = {0, 1, 2}) {
  return {corners[which[0]].cast<T>(), corners[which[1]].cast<T>(), corners[which[2]].cast<T>()};
}

/// Returns three points of the unit sphere, with themselves as normals.
inline TriangleData<double> on_sphere(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return {CornerData<double>{a, a}, {b, b}, {c, c}};
}

/// Returns the largest distance of a patch from the unit sphere over a grid of 60 x 60 places, which contains
/// the centre.
template <template <class> class Patch>
double distance_from_sphere(const TriangleData<double>& data) {
  const Patch<double> patch = patch_of<Patch>(data);
  double most = 0;
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; i + j <= 60; ++j)
      most = std::max(most, std::abs(patch.at(i / 60.0, j / 60.0, 0).position.norm() - 1));
  return most;
}

/// Returns the place at s on the side from corner i to the next one; s = 0 is corner i.
template <class T>
std::array<T, 2> corner_place(int i) {
  return {T(i == 1), T(i == 2)};
}
template <class T>
std::array<T, 2> side_place(int i, const T& s) {
  const std::array<T, 2> a = corner_place<T>(i), b = corner_place<T>((i + 1) % 3);
  return {a[0] * (T(1) - s) + b[0] * s, a[1] * (T(1) - s) + b[1] * s};
}

/// Expects that the surface interpolates its corners, bitwise, with their normals, and that its sides are edge
/// cubics.
template <template <class> class Patch, class T>
void expect_interpolation(const TriangleData<T>& data, double tolerance) {
  const Patch<T> patch = patch_of<Patch>(data);
  for (int i = 0; i < 3; ++i) {
    const CornerData<T>&a = data[i], &b = data[(i + 1) % 3], &c = data[(i + 2) % 3];
    const auto [u, v] = corner_place<T>(i);
    const PatchPoint<T> point = patch.at(u, v);
    EXPECT_EQ(point.position, a.point);
    EXPECT_LE(double((point.normal - a.normal).norm()), tolerance);
    const EdgeCubic<T> edge = edge_cubic<T>(a.point, a.normal, b.point, b.normal),
                       before = edge_cubic<T>(a.point, a.normal, c.point, c.normal);
    // The derivatives along both edges are those of the edge cubics.
    const std::array<Eigen::Vector3<T>, 3> along{point.du, point.dv - point.du, -point.dv};
    EXPECT_LE(double((along[i] - edge.tangent_a).norm()), tolerance);
    EXPECT_LE(double((-along[(i + 2) % 3] - before.tangent_a).norm()), tolerance);
    for (int k = 1; k < 16; ++k) {
      const T s = T(k) / T(16);
      const auto [x, y] = side_place<T>(i, s);
      EXPECT_LE(double((patch.at(x, y, 0).position - edge.at(T(1) - s, s)).norm()), tolerance);
    }
  }
}

/// Expects that two patches with a common edge have the same tangent planes along it, for all positions of the
/// edge in their triangles.
template <template <class> class Patch, class T>
void expect_common_planes(const std::array<CornerData<double>, 4>& corners, double tolerance) {
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      std::array<size_t, 3> left{}, right{};  // the edge from 0 to 1 is side i of one, its reverse side j of the other
      for (size_t k = 0; k < 3; ++k) {
        left[(i + k) % 3] = k;
        right[(j + k) % 3] = std::array<size_t, 3>{1, 0, 3}[k];
      }
      const Patch<T> a = patch_of<Patch>(triangle<T>(corners, left)), b = patch_of<Patch>(triangle<T>(corners, right));
      for (int k = 0; k <= 16; ++k) {
        const T s = T(k) / T(16);
        const auto [u, v] = side_place<T>(int(i), s);
        const auto [x, y] = side_place<T>(int(j), T(1) - s);
        const PatchPoint<T> p = a.at(u, v, 1), q = b.at(x, y, 1);
        EXPECT_EQ(p.status, LimitStatus::crease);
        EXPECT_LE(double((p.position - q.position).norm()), tolerance) << i << " " << j << " " << k;
        EXPECT_LE(double((p.normal - q.normal).norm()), tolerance) << i << " " << j << " " << k;
      }
    }
}

/// Expects that derivatives agree with central differences of positions in 256 bits, at interior places.
template <template <class> class Patch>
void expect_true_derivatives(const TriangleData<Precise>& data, const std::vector<std::array<double, 2>>& places) {
  const Patch<Precise> patch = patch_of<Patch>(data);
  const Precise step("1e-25");
  constexpr double tolerance = 1e-40;  // the square of the step times third and fourth derivatives
  for (const std::array<double, 2>& place : places) {
    const Precise u(place[0]), v(place[1]);
    const auto found = patch.at(u, v);
    ASSERT_EQ(found.order, 2);
    const auto right = patch.at(u + step, v), left = patch.at(u - step, v), up = patch.at(u, v + step),
               down = patch.at(u, v - step);
    const auto expect = [&](const Eigen::Vector3<Precise>& a, const Eigen::Vector3<Precise>& b,
                            const Eigen::Vector3<Precise>& derivative) {
      EXPECT_LE(double(((a - b) / (2 * step) - derivative).norm()), tolerance) << place[0] << " " << place[1];
    };
    expect(right.position, left.position, found.du);
    expect(up.position, down.position, found.dv);
    expect(right.du, left.du, found.duu);
    expect(up.du, down.du, found.duv);
    expect(right.dv, left.dv, found.duv);
    expect(up.dv, down.dv, found.dvv);
    EXPECT_LE(double(abs(found.normal.dot(found.du)) + abs(found.normal.dot(found.dv))), tolerance);
  }
}

/// Expects that results in double agree with those in 256 bits.
/// @param second  tolerance of second derivatives
template <template <class> class Patch>
void expect_precise_values(const std::array<CornerData<double>, 4>& corners, double u, double v, double tolerance,
                           double second) {
  // The same normals in both: as doubles, of which neither is of length 1 to all digits.
  TriangleData<Precise> data;
  for (size_t i = 0; i < 3; ++i) data[i] = {corners[i].point.cast<Precise>(), corners[i].normal.cast<Precise>()};
  const PatchPoint<double> found = patch_of<Patch>(triangle<double>(corners)).at(u, v);
  const PatchPoint<Precise> truth = patch_of<Patch>(data).at(Precise(u), Precise(v));
  ASSERT_EQ(found.order, truth.order) << u << " " << v;
  EXPECT_EQ(found.status, truth.status) << u << " " << v;
  const auto expect = [&](const Eigen::Vector3d& a, const Eigen::Vector3<Precise>& b, double most) {
    EXPECT_LE(double((a.cast<Precise>() - b).norm()), most) << u << " " << v;
  };
  expect(found.position, truth.position, tolerance);
  expect(found.du, truth.du, tolerance);
  expect(found.dv, truth.dv, tolerance);
  expect(found.normal, truth.normal, tolerance);
  expect(found.duu, truth.duu, second);
  expect(found.duv, truth.duv, second);
  expect(found.dvv, truth.dvv, second);
}

/// Expects that translated, rotated and scaled data give the surface transformed in this way, and that another
/// order of the corners gives the same surface.
template <template <class> class Patch>
void expect_no_preference(const std::array<CornerData<double>, 4>& corners, double tolerance) {
  const TriangleData<double> data = triangle<double>(corners);
  const Patch<double> patch = patch_of<Patch>(data);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::Vector3d shift(3, -1, 2);
  TriangleData<double> moved = data, halved = data, flipped = data;
  for (size_t i = 0; i < 3; ++i) {
    moved[i] = {3 * (turn * data[i].point) + shift, turn * data[i].normal};
    halved[i].point = std::ldexp(1.0, -700) * data[i].point;
    flipped[i].normal = -data[i].normal;
  }
  const Patch<double> other = patch_of<Patch>(moved), small = patch_of<Patch>(halved), back = patch_of<Patch>(flipped);
  const Patch<double> next = patch_of<Patch>(TriangleData<double>{data[1], data[2], data[0]}),
                      mirrored = patch_of<Patch>(TriangleData<double>{data[0], data[2], data[1]});
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; i + j <= 8; ++j) {
      const double u = i / 8.0, v = j / 8.0;
      const PatchPoint<double> p = patch.at(u, v), q = other.at(u, v), r = small.at(u, v);
      EXPECT_LE((3 * (turn * p.position) + shift - q.position).norm(), tolerance);
      EXPECT_LE((turn * p.normal - q.normal).norm(), tolerance);
      EXPECT_LE((3 * (turn * p.duv) - q.duv).norm(), 100 * tolerance);
      EXPECT_EQ(r.position, std::ldexp(1.0, -700) * p.position);  // a power of two changes no digit
      EXPECT_EQ(r.dvv, std::ldexp(1.0, -700) * p.dvv);
      EXPECT_EQ(r.normal, p.normal);
      EXPECT_EQ(back.at(u, v).position, p.position);  // which side a normal is on does not matter
      EXPECT_LE((next.at(v, 1 - u - v, 0).position - p.position).norm(), tolerance);
      EXPECT_LE((mirrored.at(v, u, 0).position - p.position).norm(), tolerance);
      EXPECT_LE((mirrored.at(v, u, 1).normal + p.normal).norm(), tolerance);
    }
}

/// Expects that data of a plane give the plane.
template <template <class> class Patch>
void expect_plane(const std::array<CornerData<double>, 4>& corners) {
  TriangleData<double> data = triangle<double>(corners);
  const Eigen::Vector3d normal(0, 0, 1);
  for (CornerData<double>& corner : data) corner = {{corner.point.x(), corner.point.y(), 0}, normal};
  const Patch<double> patch = patch_of<Patch>(data);
  for (int i = 0; i <= 6; ++i)
    for (int j = 0; i + j <= 6; ++j) {
      const PatchPoint<double> point = patch.at(i / 6.0, j / 6.0, 1);
      EXPECT_EQ(point.position.z(), 0);
      EXPECT_EQ(point.normal, normal);
    }
}

}  // namespace sublimit::testing
