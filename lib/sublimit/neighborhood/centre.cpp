// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/centre.h"

#include <algorithm>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Kind = Centre::Kind;
using Origin = Refinement::Origin;

/// Two faces glued along two edges at the tail: what is between them has no face.
bool is_digon(const Topology& t, HalfEdge h) {
  const HalfEdge other = t.ccw(h);
  return exists(other) && other != h && t.ccw(other) == h;
}

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

/// dual: the face that the fan of a half-edge becomes; a vertex of several fans has one for each.
Face dual_face(const Topology& t, const Refinement& r, HalfEdge in_fan) {
  const Vertex v = t.tail(in_fan);
  Index later = 0;  // faces of the fans after this one
  bool found = false;
  for (const HalfEdge start : t.fans(v)) {
    Index size = exists(t.twin(start)) ? 0 : 2;
    HalfEdge h = start;
    bool own = false;
    do {
      ++size;
      own |= h == in_fan;
      h = t.ccw(h);
    } while (exists(h) && h != start);
    if (own && size < 3) throw AnalysisError("a vertex becomes no face");
    if (found && size >= 3) ++later;
    found |= own;
  }
  return Face{r.face_of_vertex[index(v)] - later};
}

/// dual: the half-edge that crosses an edge, from the point of the face of h on.
HalfEdge dual_half_edge(const Topology& t, const Refinement& r, HalfEdge h) {
  const Topology& child = r.topology;
  const Vertex from = r.child(t.face(h)), to = r.child(t.face(t.twin(h)));
  HalfEdge found = no_half_edge;
  for (const HalfEdge start : child.fans(from)) {
    HalfEdge g = start;
    do {
      if (child.head(g) == to && exists(found)) throw AnalysisError("two faces have more than one edge between them");
      if (child.head(g) == to) found = g;
      g = child.ccw(g);
    } while (exists(g) && g != start);
  }
  if (!exists(found)) throw AnalysisError("an edge has lost a face");
  return found;
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
      return {is_digon(t, start) ? Kind::edge : Kind::face, child.ccw(child.ccw(start))};
    case Split::mid_edge: {  // h stays the side of its face before the corner that it leads to
      const HalfEdge side = t.prev(start), from_vertex = child.twin(side);
      if (is_digon(t, start)) return {Kind::edge, side};
      if (!open) return {Kind::face, from_vertex};
      return {level % 2 == 0 ? Kind::vertex : Kind::border, exists(from_vertex) ? child.prev(from_vertex) : side};
    }
    case Split::dual:
      if (open) return {Kind::border, border_into(child, border_child(r, start, 0))};
      if (is_digon(t, start)) return {Kind::edge, dual_half_edge(t, r, start)};
      return {Kind::face, with_tail(child, dual_face(t, r, start), r.child(t.face(start)))};
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
      return {Kind::vertex, with_tail(child, dual_face(t, r, start), r.child(t.face(start)))};
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

Centre of_edge(const Topology& t, const Refinement& r, HalfEdge start) {
  switch (r.split) {
    case Split::pqq:
    case Split::ptq:
      return {Kind::vertex, r.halves(t, start).second};
    case Split::dqq:
      return {Kind::face, r.topology.twin(start)};
    case Split::dual:
      return {Kind::edge, dual_half_edge(t, r, start)};
    case Split::keep:
      return {Kind::edge, start};
    case Split::mid_edge:
      return {Kind::vertex, start};
    default:
      throw AnalysisError("this split does not follow the middle of an edge");
  }
}

}  // namespace

Centre child(const Centre& centre, const Topology& parent, const Refinement& refinement, int level) {
  switch (centre.kind) {
    case Kind::vertex:
      return of_vertex(parent, refinement, centre.start, level);
    case Kind::face:
      return of_face(parent, refinement, centre.start, level);
    case Kind::edge:
      return of_edge(parent, refinement, centre.start);
    default:
      return of_border(parent, refinement, centre.start);
  }
}

}  // namespace sublimit
