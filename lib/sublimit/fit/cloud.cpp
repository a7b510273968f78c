// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/cloud.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

struct Triangle {
  std::array<Index, 3> corners;
  double area = 0;
};

std::vector<Triangle> triangles_of(const Mesh& mesh) {
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
    if (!mesh.positions.row(v).allFinite())
      throw InvalidMesh("vertex " + std::to_string(v) + " has a position that is not finite");
  std::vector<Triangle> triangles;
  size_t first = 0;
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    const auto size = size_t(mesh.face_sizes[size_t(f)]);
    for (size_t k = 0; k < size; ++k)
      if (const Index v = mesh.face_vertices[first + k]; v < 0 || v >= mesh.num_vertices())
        throw InvalidMesh("face " + std::to_string(f) + " has the corner " + std::to_string(v) + "; there are " +
                          std::to_string(mesh.num_vertices()) + " vertices, counted from 0");
    for (size_t k = 2; k < size; ++k) {
      const Index* c = mesh.face_vertices.data() + first;
      const Eigen::Vector3d a = mesh.positions.row(c[0]), b = mesh.positions.row(c[k - 1]),
                            d = mesh.positions.row(c[k]);
      triangles.push_back({{c[0], c[k - 1], c[k]}, (b - a).cross(d - a).norm() / 2});
    }
    first += size;
  }
  return triangles;
}

}  // namespace

Cloud cloud_of_vertices(const Mesh& mesh) {
  std::vector<double> share(size_t(mesh.num_vertices()), 0.0);
  std::vector<bool> used(share.size(), false);
  for (const Triangle& t : triangles_of(mesh))
    for (const Index v : t.corners) {
      share[size_t(v)] += t.area / 3;
      used[size_t(v)] = true;
    }
  Cloud cloud;
  cloud.points.resize(std::count(used.begin(), used.end(), true), 3);
  for (size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    cloud.points.row(Eigen::Index(cloud.weights.size())) = mesh.positions.row(Eigen::Index(v));
    cloud.weights.push_back(share[v]);
  }
  return cloud;
}

Cloud cloud_of_faces(const Mesh& mesh, Index count, unsigned seed) {
  if (count < 0) throw InvalidParameter(std::to_string(count) + " points on the faces of a mesh; 0 at least");
  const std::vector<Triangle> triangles = triangles_of(mesh);
  std::vector<double> up_to;  // area
  double area = 0;
  for (const Triangle& t : triangles) up_to.push_back(area += t.area);
  if (count > 0 && !(area > 0)) throw InvalidMesh("the faces have no area to put points on");
  std::mt19937 random(seed);
  const auto unit = [&] { return (double(random()) + 0.5) / 4294967296.0; };
  Cloud cloud{Points(count, 3)};
  for (Index i = 0; i < count; ++i) {
    // One in each count-th part of the area.
    const double at = area * (i + unit()) / count;
    const auto found = std::min<size_t>(size_t(std::lower_bound(up_to.begin(), up_to.end(), at) - up_to.begin()),
                                        triangles.size() - 1);
    double u = unit(), v = unit();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const std::array<Index, 3>& c = triangles[found].corners;
    cloud.points.row(i) =
        (1 - u - v) * mesh.positions.row(c[0]) + u * mesh.positions.row(c[1]) + v * mesh.positions.row(c[2]);
  }
  return cloud;
}

}  // namespace sublimit
