// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sublimit::gallery {
namespace {

using Eigen::Vector3d;

/// Calls use(i, j, k, weight) for the triangles of all cuts of all faces.
template <class Use>
void for_each_triangle(const Topology& topology, const Use& use) {
  for (Index f = 0; f < topology.num_faces(); ++f) {
    const auto corners = topology.vertices(Face{f});
    const size_t n = corners.size();
    if (n == 3) {
      use(corners[0], corners[1], corners[2], 1.);
      continue;
    }
    for (size_t c = 0; c < n; ++c)
      for (size_t i = 1; i + 1 < n; ++i)
        use(corners[c], corners[(c + i) % n], corners[(c + i + 1) % n], 1. / static_cast<double>(n));
  }
}

Vector3d double_area(const Points& x, Index i, Index j, Index k) {
  const Vector3d a = x.row(i), b = x.row(j), c = x.row(k);
  return (b - a).cross(c - a);
}

/// A third of the area of the triangles at each vertex.
Eigen::VectorXd vertex_areas(const Topology& topology, const Points& points) {
  Eigen::VectorXd area = Eigen::VectorXd::Zero(points.rows());
  for_each_triangle(topology, [&](Index i, Index j, Index k, double weight) {
    const double third = weight * double_area(points, i, j, k).norm() / 6;
    for (const Index v : {i, j, k}) area[v] += third;
  });
  return area;
}

}  // namespace

double volume(const Topology& topology, const Points& points) {
  double sum = 0;
  for_each_triangle(topology, [&](Index i, Index j, Index k, double weight) {
    sum += weight * double_area(points, i, j, k).dot(Vector3d(points.row(i))) / 6;
  });
  return sum;
}

double bending_energy(const Topology& topology, const Points& points) {
  Points laplacian = Points::Zero(points.rows(), 3);
  for_each_triangle(topology, [&](Index i, Index j, Index k, double weight) {
    const double area = double_area(points, i, j, k).norm();
    if (area == 0) return;
    for (const auto& [apex, a, b] : {std::array{i, j, k}, std::array{j, k, i}, std::array{k, i, j}}) {
      const double cotangent = (points.row(a) - points.row(apex)).dot(points.row(b) - points.row(apex)) / area;
      const Eigen::RowVector3d pull = weight * cotangent / 2 * (points.row(b) - points.row(a));
      laplacian.row(a) += pull;
      laplacian.row(b) -= pull;
    }
  });
  const Eigen::VectorXd area = vertex_areas(topology, points);
  double sum = 0;
  for (Eigen::Index v = 0; v < points.rows(); ++v)
    if (area[v] > 0) sum += laplacian.row(v).squaredNorm() / (4 * area[v]);
  return sum / (4 * std::numbers::pi);
}

Distances distances(const Topology& topology, const Points& points, const SurfaceDistance& other) {
  const Eigen::VectorXd area = vertex_areas(topology, points);
  Distances result;
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    const double distance = other(points.row(v));
    result.mean += area[v] * distance / area.sum();
    result.max = std::max(result.max, distance);
  }
  return result;
}

double symmetry_defect(const Topology& topology, const Points& points, std::span<const Eigen::Matrix3d> maps) {
  const SurfaceDistance surface(topology, points);
  double defect = 0;
  for (const Eigen::Matrix3d& map : maps)
    for (Eigen::Index v = 0; v < points.rows(); ++v)
      defect = std::max(defect, surface(map * points.row(v).transpose(), defect));
  return defect;
}

}  // namespace sublimit::gallery
