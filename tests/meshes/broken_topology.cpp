// SPDX-License-Identifier: Apache-2.0
#include "meshes/broken_topology.h"

#include <algorithm>
#include <set>

namespace sublimit::testing {

std::string broken(const Topology& t) {
  for (Index f = 0; f < t.num_faces(); ++f)
    if (t.size(Face{f}) < 3) return "a face has fewer than 3 corners";
  for (Index i = 0; i < t.num_half_edges(); ++i) {
    const HalfEdge h{i}, g = t.twin(h);
    if (t.prev(t.next(h)) != h || t.face(t.next(h)) != t.face(h)) return "next and prev disagree";
    if (t.corner(t.face(h), t.corner_index(h)) != h) return "a corner is not where its index says";
    if (exists(g) && (t.twin(g) != h || t.tail(g) != t.head(h) || t.head(g) != t.tail(h))) return "twins do not match";
    if (exists(g) && t.edge(g) != t.edge(h)) return "twins are on different edges";
    const std::vector<HalfEdge> halves = t.half_edges(t.edge(h));
    if (std::find(halves.begin(), halves.end(), h) == halves.end()) return "an edge does not know its half-edge";
  }
  Index last = -1;
  for (Index i = 0; i < t.num_half_edges(); ++i) {
    const Index e = index(t.edge(HalfEdge{i}));
    if (e > last + 1) return "edges are not numbered by first appearance";
    last = std::max(last, e);
  }
  for (Index v = 0; v < t.num_vertices(); ++v) {
    Index corners = 0;
    std::set<Index> seen;
    for (const HalfEdge start : t.fans(Vertex{v})) {
      HalfEdge h = start;
      do {
        if (t.tail(h) != Vertex{v}) return "a fan leaves its vertex";
        if (!seen.insert(index(h)).second) return "fans do not visit every corner once";
        ++corners;
        h = t.ccw(h);
      } while (exists(h) && h != start);
    }
    if (corners != t.num_faces(Vertex{v})) return "fans do not visit every corner once";
  }
  return {};
}

Index euler_characteristic(const Topology& t) {
  Index isolated = 0;
  for (Index v = 0; v < t.num_vertices(); ++v) isolated += t.is_isolated(Vertex{v});
  return t.num_vertices() - isolated - t.num_edges() + t.num_faces();
}

Index num_borders(const Topology& t) {
  Index count = 0;
  for (Index h = 0; h < t.num_half_edges(); ++h) count += !exists(t.twin(HalfEdge{h}));
  return count;
}

}  // namespace sublimit::testing
