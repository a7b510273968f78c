// SPDX-License-Identifier: Apache-2.0
// Dual quadrilateral split. Every corner of a face becomes a point; corner h keeps its number. Faces from faces have
// the parents' half-edges, a face from an edge (a, b) has the points
//   left at a, right at a, right at b, left at b        (right: of the two border points, where there is no right face)
// and a face from a vertex has the corners around it, counter-clockwise, closed by the border points of its two border
// edges.
#include "sublimit/splits/detail/sheets.h"

namespace sublimit {

Refinement refine_dqq(const Topology& t) {
  const Sheets sheets(t);
  const Index corners = t.num_half_edges(), edges = sheets.num_cut_edges();
  Refinement r;
  r.split = Split::dqq;
  r.from_corners = corners;
  r.borders = sheets.borders();
  r.border_points = 2;
  r.faces_from_faces = t.num_faces();
  r.faces_from_edges = edges;
  const Index vertices = corners + 2 * static_cast<Index>(r.borders.size());
  const auto border_point = [&](HalfEdge h, Index part) { return corners + 2 * sheets.border_rank(h) + part; };

  TopologyBuilder b;
  b.face_offsets.reserve(t.num_faces() + edges + sheets.num_fans() + 1);
  for (Index f = 0; f < t.num_faces(); ++f) b.face_offsets.push_back(index(t.first(Face{f})));
  for (Index e = 0; e <= edges; ++e) b.face_offsets.push_back(corners + 4 * e);
  std::vector<Index> fans;  // those that become faces: not two faces glued along two edges
  for (Index i = 0; i < sheets.num_fans(); ++i) {
    const Index size = sheets.fan_size(i) + (sheets.is_open(i) ? 2 : 0);
    if (size < 3) continue;
    fans.push_back(i);
    b.face_offsets.push_back(b.face_offsets.back() + size);
  }
  const size_t count = size_t(b.face_offsets.back());
  b.tail.resize(count);
  b.twin.resize(count);
  b.outgoing.resize(vertices);
  b.degree.resize(vertices);
  r.face_parent.resize(b.face_offsets.size() - 1);

  // The side of the edge's quad that runs across the edge at the tail of h.
  const auto across = [&](HalfEdge h) {
    const bool first = t.half_edge(t.edge(h)) == h || !exists(t.twin(h));
    return corners + 4 * sheets.cut_edge(h) + (first ? 0 : 2);
  };
  parallel_for(corners, [&](std::int64_t i) {
    const HalfEdge h{static_cast<Index>(i)}, g = t.twin(h);
    const bool first = t.half_edge(t.edge(h)) == h || !exists(g);
    const Index quad = corners + 4 * sheets.cut_edge(h);
    b.tail[i] = static_cast<Index>(i);
    b.twin[i] = quad + (first ? 3 : 1);
    b.outgoing[i] = static_cast<Index>(i);
    b.degree[i] = 4;
    if (!first) return;
    b.tail[quad] = index(h);
    b.tail[quad + 1] = exists(g) ? index(t.next(g)) : border_point(h, 0);
    b.tail[quad + 2] = exists(g) ? index(g) : border_point(h, 1);
    b.tail[quad + 3] = index(t.next(h));
    b.twin[quad] = b.twin[quad + 2] = -1;  // until a face from a vertex comes
    b.twin[quad + 1] = exists(g) ? index(g) : -1;
    b.twin[quad + 3] = index(h);
    r.face_parent[t.num_faces() + sheets.cut_edge(h)] = index(t.face(h));
    if (exists(g)) return;
    b.outgoing[border_point(h, 0)] = quad + 1;
    b.degree[border_point(h, 0)] = b.degree[border_point(h, 1)] = 2;
  });
  parallel_for(t.num_faces(), [&](std::int64_t f) { r.face_parent[f] = static_cast<Index>(f); });
  parallel_for(static_cast<std::int64_t>(fans.size()), [&](std::int64_t i) {
    const Index fan = fans[i], face = t.num_faces() + edges + static_cast<Index>(i);
    const HalfEdge start = sheets.fan_start(fan);
    const bool open = sheets.is_open(fan);
    Index at = b.face_offsets[face];
    r.face_parent[face] = index(t.face(start));
    const auto link = [&](Index side) {
      b.twin[at] = side;
      b.twin[side] = at;
    };
    if (open) {
      b.tail[at] = border_point(start, 0);
      link(across(start));
      ++at;
    }
    HalfEdge h = start;
    for (Index k = 0; k < sheets.fan_size(fan); ++k, ++at) {
      const HalfEdge into = t.prev(h), next = t.twin(into);
      b.tail[at] = index(h);
      // The quad of `into` at this vertex: seen from `next`, which leaves it, or from `into` itself on a border.
      link(exists(next) ? across(next) : corners + 4 * sheets.cut_edge(into) + 2);
      if (exists(next)) h = next;
    }
    if (open) {
      const Index last = border_point(t.prev(h), 1);
      b.tail[at] = last;
      b.twin[at] = -1;
      b.outgoing[last] = at;
    }
  });
  // Two faces glued along two edges leave no room for a face between: the edges' quads meet.
  bool pinched = false;
  for (Index i = 0; i < sheets.num_fans(); ++i) {
    if (sheets.is_open(i) || sheets.fan_size(i) > 2) continue;
    const HalfEdge h = sheets.fan_start(i), g = t.ccw(h);
    pinched = true;
    if (sheets.fan_size(i) < 2) continue;
    b.twin[across(h)] = across(g);
    b.twin[across(g)] = across(h);
  }
  r.topology = built(std::move(b), vertices, pinched);
  return r;
}

}  // namespace sublimit
