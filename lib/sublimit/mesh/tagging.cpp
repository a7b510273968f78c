// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/mesh/detail/attributes.h"
#include "sublimit/mesh/detail/check_mesh.h"
#include "sublimit/mesh/sharpness.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {
namespace {

/// A side of a face: its edge, and whether the face runs through it from the smaller number to the larger.
struct Side {
  Index low, high, face;
  bool ascends;
  friend bool operator<(const Side& a, const Side& b) {
    return std::pair(a.low, a.high) < std::pair(b.low, b.high) ||
           (std::pair(a.low, a.high) == std::pair(b.low, b.high) && a.face < b.face);
  }
};

std::vector<Index> first_corners(const Mesh& mesh) {
  std::vector<Index> first{0};
  for (const Index size : mesh.face_sizes) first.push_back(first.back() + size);
  return first;
}

/// Sides of all faces, those of an edge one after the other.
std::vector<Side> sides_of(const Mesh& mesh) {
  check_faces(view(mesh));
  std::vector<Side> sides;
  sides.reserve(mesh.face_vertices.size());
  const Index* corner = mesh.face_vertices.data();
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    const Index size = mesh.face_sizes[size_t(f)];
    for (Index k = 0; k < size; ++k) {
      const Index tail = corner[k], head = corner[(k + 1) % size];
      sides.push_back({std::min(tail, head), std::max(tail, head), f, tail < head});
    }
    corner += size;
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Calls `visit(sides)` for each edge with its sides.
void for_each_edge(const std::vector<Side>& sides, const auto& visit) {
  for (size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
    visit(std::span(sides).subspan(begin, end - begin));
  }
}

template <class T>
void turn(std::vector<T>& corners, Index first, Index size) {
  if (!corners.empty()) std::reverse(corners.begin() + first + 1, corners.begin() + first + size);
}

/// Makes the edges of two faces that `is_sharp` says so sharp.
Index add_creases(Mesh& mesh, const std::vector<Side>& sides, const auto& is_sharp) {
  std::set<std::pair<Index, Index>> tagged;
  for (const Mesh::Crease& crease : mesh.creases) tagged.insert(std::minmax(crease.tail, crease.head));
  std::vector<Mesh::Crease> creases;
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() == 2 && edge[0].face != edge[1].face && is_sharp(edge[0].face, edge[1].face) &&
        !tagged.contains({edge[0].low, edge[0].high}))
      creases.push_back({edge[0].low, edge[0].high, infinite_sharpness});
  });
  mesh.creases.insert(mesh.creases.end(), creases.begin(), creases.end());
  return static_cast<Index>(creases.size());
}

}  // namespace

std::vector<Index> orient_faces(Mesh& mesh) {
  const std::vector<Side> sides = sides_of(mesh);
  struct Neighbour {
    Index face;
    bool agrees;
  };
  std::vector<std::vector<Neighbour>> around(size_t(mesh.num_faces()));
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() != 2 || edge[0].face == edge[1].face) return;
    const bool agrees = edge[0].ascends != edge[1].ascends;
    around[size_t(edge[0].face)].push_back({edge[1].face, agrees});
    around[size_t(edge[1].face)].push_back({edge[0].face, agrees});
  });
  std::vector<Index> turned;
  std::vector<int> state(around.size(), -1);  // 0 stays, 1 is turned
  for (size_t start = 0; start < state.size(); ++start) {
    if (state[start] >= 0) continue;
    std::vector<Index> part{static_cast<Index>(start)};
    state[start] = 0;
    for (size_t i = 0; i < part.size(); ++i)
      for (const Neighbour& next : around[size_t(part[i])]) {
        if (state[size_t(next.face)] >= 0) continue;
        state[size_t(next.face)] = next.agrees ? state[size_t(part[i])] : 1 - state[size_t(part[i])];
        part.push_back(next.face);
      }
    const auto count = std::ranges::count_if(part, [&](Index f) { return state[size_t(f)] == 1; });
    const int moved = 2 * count > std::ssize(part) ? 0 : 1;
    for (const Index f : part)
      if (state[size_t(f)] == moved) turned.push_back(f);
  }
  std::sort(turned.begin(), turned.end());
  const std::vector<Index> first = first_corners(mesh);
  for (const Index f : turned) {
    const Index size = mesh.face_sizes[size_t(f)];
    turn(mesh.face_vertices, first[size_t(f)], size);
    turn(mesh.face_normals, first[size_t(f)], size);
    for (Mesh::FaceVarying& channel : mesh.face_varying) turn(channel.indices, first[size_t(f)], size);
  }
  return turned;
}

Index add_creases_by_angle(Mesh& mesh, double angle) {
  if (!(angle >= 0 && angle <= std::numbers::pi))
    throw InvalidParameter("an angle of creases is " + std::to_string(angle) + "; it should be 0 to pi");
  const std::vector<Side> sides = sides_of(mesh);
  std::vector<Eigen::Vector3d> normals;
  const double size = mesh.positions.size() > 0 ? mesh.positions.cwiseAbs().maxCoeff() : 0;
  const double unit = size > 0 ? size : 1;  // products of lengths neither vanish nor overflow
  const Index* corner = mesh.face_vertices.data();
  for (const Index size : mesh.face_sizes) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // of a fan: right for faces that are not plane, too
    const auto at = [&](Index k) {
      return Eigen::Vector3d(mesh.positions.row(corner[k]) / unit - mesh.positions.row(corner[0]) / unit);
    };
    for (Index k = 1; k + 1 < size; ++k) sum += at(k).cross(at(k + 1));
    normals.push_back(sum);
    corner += size;
  }
  return add_creases(mesh, sides, [&](Index f, Index g) {
    const Eigen::Vector3d &a = normals[size_t(f)], &b = normals[size_t(g)];
    if (a.isZero(0) || b.isZero(0)) return false;
    return std::atan2(a.cross(b).norm(), a.dot(b)) > angle;
  });
}

Index add_creases_by_smoothing_groups(Mesh& mesh) {
  const std::vector<Side> sides = sides_of(mesh);
  const Mesh::FaceNames& groups = mesh.smoothing_groups;
  if (groups.of_face.empty()) throw InvalidMesh("no face has a smoothing group; an OBJ has them as lines 's 1'");
  check_attributes(mesh);
  const auto group = [&](Index f) {
    const Index name = groups.of_face[size_t(f)];
    return name < 0 || groups.names[size_t(name)] == "off" || groups.names[size_t(name)] == "0" ? -1 : name;
  };
  return add_creases(mesh, sides, [&](Index f, Index g) { return group(f) < 0 || group(f) != group(g); });
}

void fix_border(Mesh& mesh) {
  std::vector<bool> on_border(size_t(mesh.num_vertices()), false);
  for_each_edge(sides_of(mesh), [&](std::span<const Side> edge) {
    if (edge.size() == 1) on_border[size_t(edge[0].low)] = on_border[size_t(edge[0].high)] = true;
  });
  for (Index v = 0; v < mesh.num_vertices(); ++v)
    if (on_border[size_t(v)]) mesh.corners.push_back({v, infinite_sharpness});
}

}  // namespace sublimit
