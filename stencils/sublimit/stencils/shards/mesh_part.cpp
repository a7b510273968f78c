// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/shards/mesh_part.h"

#include <algorithm>
#include <set>
#include <utility>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

/// Numbers of what is kept; -1 of the rest.
std::vector<Index> numbers_of(const std::vector<char>& kept, std::vector<std::int64_t>& of_whole) {
  std::vector<Index> numbers(kept.size(), -1);
  for (size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) {
      numbers[i] = static_cast<Index>(of_whole.size());
      of_whole.push_back(static_cast<std::int64_t>(i));
    }
  return numbers;
}

/// Both ends may be there, and the edge be one of faces that are not.
std::set<std::pair<Index, Index>> edges_of(const Mesh& mesh) {
  std::set<std::pair<Index, Index>> edges;
  const Index* corner = mesh.face_vertices.data();
  for (const Index size : mesh.face_sizes) {
    for (Index k = 0; k < size; ++k) edges.insert(std::minmax(corner[k], corner[(k + 1) % size]));
    corner += size;
  }
  return edges;
}

}  // namespace

MeshPart mesh_part(const Mesh& whole, const Topology& t, std::span<const int> owner, int part, int rings) {
  if (!whole.knot_intervals.empty())
    throw InvalidMesh("knot intervals are those of strips of faces, which a part may not see to their ends");
  std::vector<char> has_face(owner.size(), false), has_vertex(size_t(t.num_vertices()), false);
  for (size_t f = 0; f < owner.size(); ++f) has_face[f] = owner[f] == part;
  const auto take_vertices = [&] {
    for (Index f = 0; f < t.num_faces(); ++f)
      if (has_face[size_t(f)])
        for (const Index v : t.vertices(Face{f})) has_vertex[size_t(v)] = true;
  };
  take_vertices();
  for (int ring = 0; ring < rings; ++ring) {
    for (Index f = 0; f < t.num_faces(); ++f)
      if (!has_face[size_t(f)])
        for (const Index v : t.vertices(Face{f})) has_face[size_t(f)] |= has_vertex[size_t(v)];
    take_vertices();
  }
  for (Index v = 0; v < t.num_vertices() && part == 0; ++v)
    if (t.is_isolated(Vertex{v})) has_vertex[size_t(v)] = true;

  MeshPart result;
  const std::vector<Index> vertex = numbers_of(has_vertex, result.vertices), face = numbers_of(has_face, result.faces);
  Mesh& mesh = result.mesh;
  mesh.boundary = whole.boundary, mesh.creasing = whole.creasing, mesh.triangles = whole.triangles;
  mesh.positions = whole.positions(result.vertices, Eigen::all);
  for (const std::int64_t f : result.faces) {
    result.is_owned.push_back(owner[size_t(f)] == part);
    mesh.face_sizes.push_back(whole.face_sizes[size_t(f)]);
    for (const Index v : t.vertices(Face{static_cast<Index>(f)})) mesh.face_vertices.push_back(vertex[size_t(v)]);
  }
  if (!whole.creases.empty()) {
    const std::set<std::pair<Index, Index>> edges = edges_of(mesh);
    for (const Mesh::Crease& crease : whole.creases) {
      const Index a = vertex[size_t(crease.tail)], b = vertex[size_t(crease.head)];
      if (edges.count(std::minmax(a, b))) mesh.creases.push_back({a, b, crease.sharpness});
    }
  }
  for (const Mesh::Corner& corner : whole.corners)
    if (vertex[size_t(corner.vertex)] >= 0) mesh.corners.push_back({vertex[size_t(corner.vertex)], corner.sharpness});
  for (const Index hole : whole.holes)
    if (face[size_t(hole)] >= 0) mesh.holes.push_back(face[size_t(hole)]);
  return result;
}

}  // namespace sublimit
