// SPDX-License-Identifier: Apache-2.0
// Dual: every face becomes a point, every vertex the face of the points around it. The half-edge that leaves the point
// of corner h crosses the edge before h. Border edges become points too, so that the border is refined and does not
// shrink.
#include "sublimit/splits/detail/sheets.h"

namespace sublimit {

Refinement refine_dual(const Topology& t) {
  const Sheets sheets(t);
  Refinement r;
  r.split = Split::dual;
  r.from_faces = t.num_faces();
  r.borders = sheets.borders();
  r.border_points = 1;
  const Index vertices = r.from_faces + static_cast<Index>(r.borders.size());
  const auto border_point = [&](HalfEdge h) { return r.from_faces + sheets.border_rank(h); };

  TopologyBuilder b;
  b.face_offsets = {0};
  std::vector<Index> fans;
  UninitializedVector<Index> position(t.num_half_edges());  // child half-edge of each corner
  parallel_for(t.num_half_edges(), [&](std::int64_t h) { position[h] = -1; });
  r.face_of_vertex.assign(t.num_vertices(), -1);
  for (Index i = 0; i < sheets.num_fans(); ++i) {
    const bool open = sheets.is_open(i);
    const Index size = sheets.fan_size(i) + (open ? 2 : 0);
    if (size < 3) continue;
    r.face_of_vertex[index(t.tail(sheets.fan_start(i)))] = static_cast<Index>(fans.size());
    fans.push_back(i);
    HalfEdge h = sheets.fan_start(i);
    for (Index k = 0, at = b.face_offsets.back() + (open ? 1 : 0); k < sheets.fan_size(i); ++k, h = t.ccw(h))
      position[index(h)] = at++;
    b.face_offsets.push_back(b.face_offsets.back() + size);
  }
  const size_t count = size_t(b.face_offsets.back());
  b.tail.resize(count);
  b.twin.resize(count);
  r.face_parent.resize(fans.size());
  parallel_for(static_cast<std::int64_t>(fans.size()), [&](std::int64_t i) {
    const Index fan = fans[i];
    const HalfEdge start = sheets.fan_start(fan);
    const bool open = sheets.is_open(fan);
    Index at = b.face_offsets[i];
    r.face_parent[i] = index(t.face(start));
    if (open) {  // from the border point of the first edge to the first face: seen from the edge's other end, the way
                 // back
      b.tail[at] = border_point(start);
      b.twin[at] = position[index(t.next(start))];
      ++at;
    }
    HalfEdge h = start;
    for (Index k = 0; k < sheets.fan_size(fan); ++k, ++at) {
      const HalfEdge into = t.prev(h), next = t.twin(into);
      b.tail[at] = index(t.face(h));
      if (exists(next)) {
        b.twin[at] = position[index(t.next(next))];
        h = next;
      } else {  // to the border point of `into`: its tail's face starts there
        b.twin[at] = position[index(into)] - 1;
      }
    }
    if (open) {
      b.tail[at] = border_point(t.prev(h));
      b.twin[at] = -1;
    }
  });
  for (Index i = 0; i < sheets.num_fans(); ++i) {  // two faces glued along two edges: the sides that cross these meet
    if (sheets.is_open(i) || sheets.fan_size(i) != 2) continue;
    const HalfEdge h = sheets.fan_start(i), g = t.ccw(h);
    const Index a = position[index(t.next(h))], c = position[index(t.next(g))];
    if (a < 0 || c < 0) continue;
    b.twin[a] = c;
    b.twin[c] = a;
  }
  for (Index h = 0; h < static_cast<Index>(count); ++h)  // a side next to another vertex that became no face
    if (b.twin[h] >= 0 && b.twin[b.twin[h]] != h) b.twin[h] = -1;
  r.topology = built(std::move(b), vertices, true);
  return r;
}

Refinement refine_keep(const Topology& t) {
  Refinement r;
  r.split = Split::keep;
  r.topology = t;
  r.from_vertices = t.num_vertices();
  r.faces_from_faces = t.num_faces();
  r.face_parent.resize(t.num_faces());
  parallel_for(t.num_faces(), [&](std::int64_t f) { r.face_parent[f] = static_cast<Index>(f); });
  return r;
}

}  // namespace sublimit
