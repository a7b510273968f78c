// SPDX-License-Identifier: Apache-2.0
#include "sublimit/analysis/centre.h"

#include <algorithm>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Kind = Centre::Kind;

/// The border half-edge that ends in a border vertex.
HalfEdge border_into(const Topology& t, Vertex v) {
  HalfEdge h = t.outgoing(v);
  while (exists(t.ccw(h))) h = t.ccw(h);
  return t.prev(h);
}

HalfEdge with_tail(const Topology& t, Face f, Vertex v) {
  for (Index k = 0; k < t.size(f); ++k)
    if (t.tail(t.corner(f, k)) == v) return t.corner(f, k);
  throw AnalysisError("a face from a vertex has lost a corner");
}

/// The half-edge from the child of the tail of h to the point of a face at it.
HalfEdge towards_face(const Topology& child, const Refinement& r, Vertex v, Face face) {
  const HalfEdge start = child.outgoing(v);
  HalfEdge h = start;
  do {
    const Vertex end = child.head(h);
    if (r.origin(end) == Refinement::Origin::face && r.parent(end) == index(face)) return h;
    h = child.ccw(h);
  } while (exists(h) && h != start);
  return start;
}

Vertex border_child(const Refinement& r, HalfEdge border, Index part) {
  const auto at = std::lower_bound(r.borders.begin(), r.borders.end(), index(border)) - r.borders.begin();
  return Vertex{r.first_border_child() + r.border_points * static_cast<Index>(at) + part};
}

Centre of_vertex(const Topology& t, const Refinement& r, HalfEdge start, int level) {
  const Topology& child = r.topology;
  const Vertex v = t.tail(start);
  const bool open = !exists(t.twin(start));
  switch (r.split) {
    case Split::pqq:
    case Split::ptq:
      return {Kind::vertex, r.halves(t, start).first};
    case Split::keep:
      return {Kind::vertex, start};
    case Split::sqrt3:
      if (open) return {Kind::vertex, child.outgoing(r.child(v))};
      return {Kind::vertex, towards_face(child, r, r.child(v), t.face(level % 2 == 0 ? t.twin(start) : start))};
    case Split::dqq:
      if (open) return {Kind::border, border_into(child, border_child(r, start, 0))};
      return {Kind::face, child.ccw(child.ccw(start))};
    case Split::mid_edge:
      if (!open) return {Kind::face, child.twin(t.prev(start))};
      if (level % 2 == 1) return {Kind::border, border_into(child, r.child(t.edge(start)))};
      return {Kind::vertex, child.outgoing(Vertex{static_cast<Index>(
                                std::lower_bound(r.vertex_list.begin(), r.vertex_list.end(), index(v)) - r.vertex_list.begin())})};
    case Split::dual:
      if (open) return {Kind::border, border_into(child, border_child(r, start, 0))};
      return {Kind::face, with_tail(child, Face{r.face_of_vertex[index(v)]}, r.child(t.face(start)))};
    default:
      return {Kind::vertex, child.outgoing(r.child(v))};
  }
}

Centre of_face(const Topology& t, const Refinement& r, HalfEdge start, int level) {
  const Topology& child = r.topology;
  switch (r.split) {
    case Split::pqq: {  // the corner's quad, at the face's point
      const Face quad = child.face(r.halves(t, start).first);
      return {Kind::vertex, with_tail(child, quad, r.child(t.face(start)))};
    }
    case Split::dqq:
    case Split::keep:
      return {Kind::face, start};
    case Split::mid_edge:
      return {Kind::face, level % 2 == 0 ? start : t.prev(start)};
    case Split::dual:
      return {Kind::vertex, with_tail(child, Face{r.face_of_vertex[index(t.tail(start))]}, r.child(t.face(start)))};
    default:
      throw AnalysisError("this split does not follow the middle of a face");
  }
}

Centre of_border(const Topology& t, const Refinement& r, HalfEdge start) {
  const Topology& child = r.topology;
  switch (r.split) {
    case Split::dqq:
      return {Kind::border, child.outgoing(border_child(r, start, 0))};
    case Split::dual:
      return {Kind::vertex, child.outgoing(border_child(r, start, 0))};
    case Split::keep:
      return {Kind::border, start};
    default:
      return {Kind::vertex, child.outgoing(r.child(t.edge(start)))};
  }
}

}  // namespace

Centre child(const Centre& centre, const Topology& parent, const Refinement& refinement, int level) {
  switch (centre.kind) {
    case Kind::vertex:
      return of_vertex(parent, refinement, centre.start, level);
    case Kind::face:
      return of_face(parent, refinement, centre.start, level);
    default:
      return of_border(parent, refinement, centre.start);
  }
}

}  // namespace sublimit
