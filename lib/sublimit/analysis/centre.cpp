// SPDX-License-Identifier: Apache-2.0
#include "sublimit/analysis/centre.h"

#include <algorithm>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Kind = Centre::Kind;
using Origin = Refinement::Origin;

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

/// The half-edge from child vertex v to a child of `parent`, in whichever fan; a border's part is the one at its tail.
HalfEdge spoke(const Refinement& r, Vertex v, Origin origin, Index parent) {
  const Topology& child = r.topology;
  for (const HalfEdge start : child.fans(v)) {
    HalfEdge h = start;
    do {
      const Vertex head = child.head(h);
      const bool is_border = origin == Origin::border;
      if (r.origin(head) == origin && r.parent(head) == parent && (!is_border || r.part(head) == 0)) return h;
      h = child.ccw(h);
    } while (exists(h) && h != start);
  }
  throw AnalysisError("a vertex has lost a neighbour");
}

/// Clockwise to the start of an open fan.
HalfEdge first_of_fan(const Topology& t, HalfEdge h) {
  while (exists(t.twin(h))) h = t.next(t.twin(h));
  return h;
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
    case Split::sqrt3: {
      if (level % 2 == 0) return {Kind::vertex, HalfEdge{3 * index(start)}};
      if (open) return {Kind::vertex, spoke(r, r.child(v), Origin::border, index(start))};
      // A face that was cut from its border has no point, but the border's.
      const HalfEdge opposite = t.next(start);
      const bool cut = !exists(t.twin(opposite)) && exists(t.twin(t.next(opposite)));
      return {Kind::vertex, cut ? spoke(r, r.child(v), Origin::border, index(opposite))
                                : spoke(r, r.child(v), Origin::face, index(t.face(start)))};
    }
    case Split::dqq:
      if (open) return {Kind::border, border_into(child, border_child(r, start, 0))};
      return {Kind::face, child.ccw(child.ccw(start))};
    case Split::mid_edge: {  // h stays the side of its face before the corner that it leads to
      const HalfEdge side = t.prev(start), from_vertex = child.twin(side);
      if (!open) return {Kind::face, from_vertex};
      return {level % 2 == 0 ? Kind::vertex : Kind::border, exists(from_vertex) ? child.prev(from_vertex) : side};
    }
    case Split::dual:
      if (open) return {Kind::border, border_into(child, border_child(r, start, 0))};
      return {Kind::face, with_tail(child, Face{r.face_of_vertex[index(v)]}, r.child(t.face(start)))};
    default: {
      const HalfEdge to_face = spoke(r, r.child(v), Origin::face, index(t.face(start)));
      return {Kind::vertex, open ? first_of_fan(child, to_face) : to_face};
    }
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
    case Split::mid_edge:
      return {Kind::vertex, child.outgoing(child.tail(start))};
    default:
      return {Kind::vertex, r.halves(t, start).second};
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
