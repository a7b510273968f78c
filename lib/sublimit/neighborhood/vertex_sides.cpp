// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/vertex_sides.h"

namespace sublimit {
namespace {

/// Where the sides of a fan start: a closed fan at the first of its sharp edges.
HalfEdge first_of_fan(const Level& level, HalfEdge start) {
  const Topology& t = level.topology();
  if (!exists(t.twin(start))) return start;
  HalfEdge h = start;
  while (!is_cut(t, level.sharpness, h) && t.ccw(h) != start) h = t.ccw(h);
  return is_cut(t, level.sharpness, h) ? h : start;
}

}  // namespace

VertexSides vertex_sides(const Level& level) {
  const Topology& t = level.topology();
  const auto is_cut = [&](HalfEdge h) { return sublimit::is_cut(t, level.sharpness, h); };
  VertexSides sides;
  sides.corner_side.assign(t.num_half_edges(), -1);
  for (Index v = 0; v < t.num_vertices(); ++v)
    for (const HalfEdge fan : t.fans(Vertex{v})) {
      const HalfEdge start = first_of_fan(level, fan);
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

Centre first_side(const Level& level, HalfEdge corner) {
  const Topology& t = level.topology();
  for (const HalfEdge fan : t.fans(t.tail(corner))) {
    HalfEdge h = fan;
    do {
      if (h == corner) return {Centre::Kind::vertex, first_of_fan(level, fan)};
      h = t.ccw(h);
    } while (exists(h) && h != fan);
  }
  return side_of(level, corner);
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
