// SPDX-License-Identifier: Apache-2.0
// One quadrilateral for each edge (a, b): a, the right face's point, b, the left face's. A border has its midpoint for
// the face that is missing, so that it stays a quadrilateral.
#include "sublimit/splits/detail/sheets.h"

namespace sublimit {

Refinement refine_quads(const Topology& t) {
  const Sheets sheets(t);
  Refinement r;
  r.split = Split::quads;
  r.from_vertices = t.num_vertices();
  r.from_faces = t.num_faces();
  r.borders = sheets.borders();
  r.border_points = 1;
  r.faces_from_edges = sheets.num_cut_edges();
  const Index vertices = r.first_border_child() + static_cast<Index>(r.borders.size());
  TopologyBuilder b;
  const size_t count = 4 * size_t(sheets.num_cut_edges());
  b.tail.resize(count);
  b.twin.resize(count);
  r.face_parent.resize(sheets.num_cut_edges());
  for (Index e = 0; e <= sheets.num_cut_edges(); ++e) b.face_offsets.push_back(4 * e);
  const auto is_first = [&](HalfEdge h) { return t.half_edge(t.edge(h)) == h || !exists(t.twin(h)); };
  // Sides of the quad: a to the right face's point and on to b, on to the left face's point, back to a.
  const auto to_point = [&](HalfEdge h) { return 4 * sheets.cut_edge(h) + (is_first(h) ? 2 : 0); };  // head to h's face
  const auto from_point = [&](HalfEdge h) {
    return 4 * sheets.cut_edge(h) + (is_first(h) ? 3 : 1);
  };  // h's face to tail
  for (Index i = 0; i < t.num_half_edges(); ++i) {
    const HalfEdge h{i}, g = t.twin(h);
    b.twin[to_point(h)] = from_point(t.next(h));
    b.twin[from_point(h)] = to_point(t.prev(h));
    if (!is_first(h)) continue;
    const Index at = 4 * sheets.cut_edge(h);
    b.tail[at] = index(t.tail(h));
    b.tail[at + 1] = exists(g) ? index(r.child(t.face(g))) : r.first_border_child() + sheets.border_rank(h);
    b.tail[at + 2] = index(t.head(h));
    b.tail[at + 3] = index(r.child(t.face(h)));
    if (!exists(g)) b.twin[at] = b.twin[at + 1] = -1;
    r.face_parent[at / 4] = index(t.face(h));
  }
  r.topology = built(std::move(b), vertices, true);
  return r;
}

}  // namespace sublimit
