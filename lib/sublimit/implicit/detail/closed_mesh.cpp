// SPDX-License-Identifier: Apache-2.0
#include "sublimit/implicit/detail/closed_mesh.h"

#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {
namespace {

std::string at(const Mesh& mesh, Vertex v) {
  const auto p = mesh.positions.row(index(v));
  return "vertex " + format_number(index(v)) + " at (" + format_number(p[0]) + ", " + format_number(p[1]) + ", " +
         format_number(p[2]) + ")";
}

}  // namespace

ClosedMeshCounts closed_mesh_counts(const Mesh& mesh) {
  const Topology topology(view(mesh));
  for (Index e = 0; e < topology.num_edges(); ++e) {
    const Edge edge{e};
    const bool border = topology.is_boundary(edge);
    if (!border && !topology.is_nonmanifold(edge)) continue;
    throw InvalidMesh("the surface is " + std::string(border ? "open" : "no manifold") + " at the edge from " +
                      at(mesh, topology.tail(edge)) + " to " + at(mesh, topology.head(edge)) +
                      (border ? "" : ": it nearly touches itself there") + "; take another number of cells");
  }
  for (Index v = 0; v < topology.num_vertices(); ++v)
    if (topology.is_isolated(Vertex{v}) || topology.is_nonmanifold(Vertex{v}))
      throw InvalidMesh("the surface is no manifold at " + at(mesh, Vertex{v}) + "; take another number of cells");
  ClosedMeshCounts counts{.euler = topology.num_vertices() - topology.num_edges() + topology.num_faces()};
  std::vector<bool> seen(size_t(topology.num_faces()), false);
  for (Index first = 0; first < topology.num_faces(); ++first) {
    if (seen[size_t(first)]) continue;
    ++counts.components;
    seen[size_t(first)] = true;
    for (std::vector<Index> open{first}; !open.empty();) {
      const Face face{open.back()};
      open.pop_back();
      for (Index i = 0; i < topology.size(face); ++i) {
        const Index next = index(topology.face(topology.twin(topology.corner(face, i))));
        if (seen[size_t(next)]) continue;
        seen[size_t(next)] = true;
        open.push_back(next);
      }
    }
  }
  return counts;
}

Index split_pinches(Mesh& mesh) {
  const Topology topology(view(mesh));
  Index count = 0, next = topology.num_vertices();
  std::vector<Index> copies;  // of which vertex each new one is
  for (Index v = 0; v < topology.num_vertices(); ++v) {
    const std::vector<HalfEdge> fans = topology.fans(Vertex{v});
    if (fans.size() < 2) continue;
    ++count;
    for (size_t i = 1; i < fans.size(); ++i, ++next) {
      copies.push_back(v);
      HalfEdge h = fans[i];
      do {
        mesh.face_vertices[size_t(index(h))] = next;
        h = topology.ccw(h);
      } while (exists(h) && h != fans[i]);
    }
  }
  const Eigen::Index before = mesh.positions.rows();
  mesh.positions.conservativeResize(next, Eigen::NoChange);
  for (size_t i = 0; i < copies.size(); ++i)
    mesh.positions.row(before + Eigen::Index(i)) = mesh.positions.row(copies[i]);
  return count;
}

}  // namespace sublimit
