// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/vertex_sides.h"

namespace sublimit {

VertexSides vertex_sides(const Level& level) {
  const Topology& t = level.topology();
  const auto is_cut = [&](HalfEdge h) { return sublimit::is_cut(t, level.sharpness, h); };
  VertexSides sides;
  sides.corner_side.assign(t.num_half_edges(), -1);
  for (Index v = 0; v < t.num_vertices(); ++v)
    for (HalfEdge start : t.fans(Vertex{v})) {
      // A closed fan starts at the first of its sharp edges.
      const HalfEdge first = start;
      if (exists(t.twin(start))) {
        HalfEdge h = start;
        while (!is_cut(h) && t.ccw(h) != first) h = t.ccw(h);
        if (is_cut(h)) start = h;
      }
      HalfEdge h = start;
      bool hole = true, begins = true;
      do {
        if (begins) {
          sides.centres.push_back({Centre::Kind::vertex, h});
          sides.vertex.push_back(v);
          hole = true;
        }
        sides.corner_side[index(h)] = static_cast<Index>(sides.centres.size()) - 1;
        hole &= level.holes[index(t.face(h))];
        begins = is_cut(t.prev(h));
        if (begins || t.ccw(h) == start) sides.hole.push_back(hole);
        h = t.ccw(h);
      } while (exists(h) && h != start);
    }
  return sides;
}

Centre side_of(const Level& level, HalfEdge corner) {
  const Topology& t = level.topology();
  HalfEdge h = corner;
  while (!is_cut(t, level.sharpness, h)) {
    h = t.next(t.twin(h));
    if (h == corner) break;
  }
  return {Centre::Kind::vertex, h};
}

std::vector<bool> vertices_without_surface(const Topology& t, const std::vector<bool>& holes) {
  std::vector<bool> without(t.num_vertices(), true);
  for (Index f = 0; f < t.num_faces(); ++f)
    if (!holes[f])
      for (const Index v : t.vertices(Face{f})) without[v] = false;
  return without;
}

}  // namespace sublimit
