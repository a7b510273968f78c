// SPDX-License-Identifier: Apache-2.0
#include "meshes/same_mesh.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

namespace sublimit::testing {
namespace {

/// Points by a distance along a direction that no two of them share.
std::vector<Index> sorted(const Points& points) {
  const Eigen::Vector3d direction(0.3217, 0.5171, 0.7931);
  const Eigen::VectorXd along = points * direction;
  std::vector<Index> order(size_t(points.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index i, Index j) { return along[i] < along[j]; });
  return order;
}

/// Faces by their points, from the first of them on: where their corners begin, and which one comes first.
struct Corners {
  size_t first = 0, turn = 0, size = 0;
  size_t at(size_t k) const { return first + (turn + k) % size; }
};
std::multimap<std::vector<Index>, Corners> faces_of(const Mesh& mesh, const std::vector<Index>& name) {
  std::multimap<std::vector<Index>, Corners> faces;
  size_t first = 0;
  for (const Index size : mesh.face_sizes) {
    std::vector<Index> own;
    for (size_t k = 0; k < size_t(size); ++k) own.push_back(name[size_t(mesh.face_vertices[first + k])]);
    const auto start = std::min_element(own.begin(), own.end());
    const auto turn = size_t(start - own.begin());
    std::rotate(own.begin(), start, own.end());
    faces.emplace(std::move(own), Corners{first, turn, size_t(size)});
    first += size_t(size);
  }
  return faces;
}

std::map<std::pair<Index, Index>, float> creases_of(const Mesh& mesh, const std::vector<Index>& name) {
  std::map<std::pair<Index, Index>, float> creases;
  for (const Mesh::Crease& c : mesh.creases)
    creases[std::minmax({name[size_t(c.tail)], name[size_t(c.head)]})] = c.sharpness;
  return creases;
}

std::map<Index, float> corners_of(const Mesh& mesh, const std::vector<Index>& name) {
  std::map<Index, float> corners;
  for (const Mesh::Corner& c : mesh.corners) corners[name[size_t(c.vertex)]] = c.sharpness;
  return corners;
}

std::string counts(const char* what, size_t a, size_t b) {
  return std::to_string(a) + " and " + std::to_string(b) + " " + what;
}

}  // namespace

std::string difference(const Mesh& a, const Mesh& b, double tolerance) {
  if (a.num_vertices() != b.num_vertices()) return counts("points", size_t(a.num_vertices()), size_t(b.num_vertices()));
  if (a.num_faces() != b.num_faces()) return counts("faces", size_t(a.num_faces()), size_t(b.num_faces()));
  const std::vector<Index> order_a = sorted(a.positions), order_b = sorted(b.positions);
  std::vector<Index> name_a(order_a.size()), name_b(order_b.size());
  for (size_t i = 0; i < order_a.size(); ++i) {
    const double far = (a.positions.row(order_a[i]) - b.positions.row(order_b[i])).cwiseAbs().maxCoeff();
    if (!(far <= tolerance)) return "points apart by " + std::to_string(far);
    name_a[size_t(order_a[i])] = name_b[size_t(order_b[i])] = static_cast<Index>(i);
  }
  if (a.face_varying.empty() != b.face_varying.empty()) return "only one has texture coordinates";
  const auto faces_a = faces_of(a, name_a), faces_b = faces_of(b, name_b);
  for (auto x = faces_a.begin(), y = faces_b.begin(); x != faces_a.end(); ++x, ++y) {
    if (x->first != y->first) return "a face of other points";
    for (size_t k = 0; k < x->second.size && !a.face_varying.empty(); ++k) {
      const auto &own = a.face_varying[0], &other = b.face_varying[0];
      const double far =
          (own.values.row(own.indices[x->second.at(k)]) - other.values.row(other.indices[y->second.at(k)]))
              .cwiseAbs()
              .maxCoeff();
      if (!(far <= tolerance)) return "texture coordinates apart by " + std::to_string(far);
    }
  }
  if (creases_of(a, name_a) != creases_of(b, name_b))
    return "creases differ, " + counts("", a.creases.size(), b.creases.size());
  if (corners_of(a, name_a) != corners_of(b, name_b))
    return "corners differ, " + counts("", a.corners.size(), b.corners.size());
  return "";
}

}  // namespace sublimit::testing
