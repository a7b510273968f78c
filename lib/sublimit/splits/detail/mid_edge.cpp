// SPDX-License-Identifier: Apache-2.0
// Mid-edge split. Every edge becomes a point; a face from a face has the parents' half-edges, half-edge h now running
// from the point of h to that of the next one; a face from a vertex has the points of its edges, counter-clockwise.
//
// At borders two steps must double the points, as they do inside: even levels keep the vertex, so that its face ends in
// it, odd levels cut it off. So the border runs through p, m, q and then through the quarter points, as Chaikin's.
#include "sublimit/splits/detail/sheets.h"

namespace sublimit {

Refinement refine_mid_edge(const Topology& t, int level) {
  const Sheets sheets(t);
  const bool keeps = level % 2 == 0;
  const Index corners = t.num_half_edges();
  Refinement r;
  r.split = Split::mid_edge;
  std::vector<Index> fans, kept(sheets.num_fans(), -1);
  TopologyBuilder b;
  for (Index f = 0; f < t.num_faces(); ++f) b.face_offsets.push_back(index(t.first(Face{f})));
  b.face_offsets.push_back(corners);
  for (Index i = 0; i < sheets.num_fans(); ++i) {
    const bool open = sheets.is_open(i);
    if (open && keeps) {
      kept[i] = static_cast<Index>(r.vertex_list.size());
      r.vertex_list.push_back(index(t.tail(sheets.fan_start(i))));
    }
    const Index size = sheets.fan_size(i) + (open ? (keeps ? 2 : 1) : 0);
    if (size < 3) continue;
    fans.push_back(i);
    b.face_offsets.push_back(b.face_offsets.back() + size);
  }
  r.from_vertices = static_cast<Index>(r.vertex_list.size());
  r.from_edges = sheets.num_cut_edges();
  r.edge_list = sheets.edge_list();
  r.faces_from_faces = t.num_faces();
  const Index vertices = r.from_vertices + r.from_edges;
  const auto middle = [&](HalfEdge h) { return r.from_vertices + sheets.cut_edge(h); };

  const size_t count = size_t(b.face_offsets.back());
  b.tail.resize(count);
  b.twin.resize(count);
  r.face_parent.resize(b.face_offsets.size() - 1);
  parallel_for(corners, [&](std::int64_t i) {
    b.tail[i] = middle(HalfEdge{static_cast<Index>(i)});
    b.twin[i] = -1;  // until a face from a vertex comes
  });
  parallel_for(t.num_faces(), [&](std::int64_t f) { r.face_parent[f] = static_cast<Index>(f); });
  parallel_for(static_cast<std::int64_t>(fans.size()), [&](std::int64_t i) {
    const Index fan = fans[i], face = t.num_faces() + static_cast<Index>(i);
    const bool open = sheets.is_open(fan);
    Index at = b.face_offsets[face];
    HalfEdge h = sheets.fan_start(fan);
    r.face_parent[face] = index(t.face(h));
    for (Index k = 0; k < sheets.fan_size(fan); ++k, ++at) {
      const HalfEdge into = t.prev(h);
      b.tail[at] = middle(h);
      b.twin[at] = index(into);
      b.twin[index(into)] = at;
      if (exists(t.twin(into))) h = t.twin(into);
    }
    if (!open) return;
    b.tail[at] = middle(t.prev(h));
    b.twin[at] = -1;
    if (keeps) {
      b.tail[++at] = kept[fan];
      b.twin[at] = -1;
    }
  });
  for (Index i = 0; i < sheets.num_fans(); ++i) {  // two faces glued along two edges: their own new sides meet
    if (sheets.is_open(i) || sheets.fan_size(i) != 2) continue;
    const HalfEdge h = sheets.fan_start(i), g = t.ccw(h);
    b.twin[index(t.prev(h))] = index(t.prev(g));
    b.twin[index(t.prev(g))] = index(t.prev(h));
  }
  r.topology = built(std::move(b), vertices, true);
  return r;
}

}  // namespace sublimit
