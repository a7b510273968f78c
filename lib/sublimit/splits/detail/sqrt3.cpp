// SPDX-License-Identifier: Apache-2.0
// sqrt(3) split (Kobbelt 2000): a point for each face, joined to its corners and, across flipped old edges, to its
// neighbours. Half-edge h with a twin becomes triangle (tail, point of the twin's side, point of h's side). A border
// edge is left alone in even levels: triangle (tail, head, point). In odd levels it is trisected; its face then gets no
// point of its own, since two steps together cut every old triangle into nine: the border half-edge becomes (first
// third, second third, opposite corner), and for the face's other edges the nearer one of the two is the point of this
// side.
#include "sublimit/splits/detail/sheets.h"

namespace sublimit {
namespace {

class Sqrt3 {
 public:
  Sqrt3(const Topology& topology, bool trisects) : t(topology), sheets(topology) {
    const Index corners = t.num_half_edges();
    border_of.assign(t.num_faces(), -1);
    if (trisects) {
      std::vector<Index> count(t.num_faces(), 0);
      for (const Index h : sheets.borders()) ++count[index(t.face(HalfEdge{h}))];
      for (const Index h :
           sheets.borders())  // a face with several borders keeps its point (not met after an even level)
        if (count[index(t.face(HalfEdge{h}))] == 1) border_of[index(t.face(HalfEdge{h}))] = h;
    }
    point_of.resize(t.num_faces());
    first_.resize(corners + 1);
    Index points = t.num_vertices();
    for (Index f = 0; f < t.num_faces(); ++f) {
      if (border_of[f] >= 0) {
        point_of[f] = -1;
        continue;
      }
      point_of[f] = points++;
      face_list.push_back(f);
    }
    num_points = points;
    first_[0] = 0;
    for (Index h = 0; h < corners; ++h) first_[h + 1] = first_[h] + 3 * triangles(HalfEdge{h}, trisects);
  }

  bool is_border(HalfEdge h) const { return !exists(t.twin(h)); }
  Index first(HalfEdge h) const { return first_[index(h)]; }
  Index triangles(HalfEdge h) const { return (first_[index(h) + 1] - first_[index(h)]) / 3; }
  Index num_half_edges() const { return first_.back(); }
  Index third(HalfEdge border, Index k) const { return num_points + 2 * sheets.border_rank(border) + k; }

  /// Child vertex that stands for the side of h.
  Index point(HalfEdge h) const {
    const Index f = index(t.face(h));
    if (border_of[f] < 0) return point_of[f];
    const HalfEdge border{border_of[f]};
    return third(border, h == t.next(border) ? 1 : 0);
  }
  /// Twin of the child half-edge from the point to the tail of h, on the other side of that segment.
  Index beside_tail(HalfEdge h) const {
    const Index f = index(t.face(h));
    if (border_of[f] >= 0) return h == t.next(HalfEdge{border_of[f]}) ? -1 : first(HalfEdge{border_of[f]}) + 2;
    const HalfEdge before = t.prev(h);
    return is_border(before) ? first(before) + 3 * (triangles(before) - 1) + 1 : first(t.twin(before));
  }
  /// Twin of the child half-edge from the head of h to the point.
  Index beside_head(HalfEdge h) const {
    const Index f = index(t.face(h));
    if (border_of[f] >= 0) return h == t.next(HalfEdge{border_of[f]}) ? first(HalfEdge{border_of[f]}) + 1 : -1;
    return first(t.next(h)) + 2;
  }

  const Topology& t;
  const Sheets sheets;
  std::vector<Index> border_of;  // of faces that are cut from their border
  std::vector<Index> point_of, face_list;
  Index num_points = 0;

 private:
  Index triangles(HalfEdge h, bool trisects) const {
    return is_border(h) && trisects && border_of[index(t.face(h))] < 0 ? 3 : 1;
  }
  std::vector<Index> first_;
};

}  // namespace

Refinement refine_sqrt3(const Topology& t, int level) {
  check_triangles(t);
  const bool trisects = level % 2 == 1;
  const Sqrt3 s(t, trisects);
  Refinement r;
  r.split = Split::sqrt3;
  r.from_vertices = t.num_vertices();
  r.from_faces = static_cast<Index>(s.face_list.size());
  if (trisects) {
    r.borders = s.sheets.borders();
    r.border_points = 2;
    if (!r.borders.empty()) r.face_list = s.face_list;
  }
  const Index vertices = r.first_border_child() + r.border_points * static_cast<Index>(r.borders.size());
  r.faces_from_faces = s.num_half_edges() / 3;
  TopologyBuilder b;
  b.tail.resize(s.num_half_edges());
  b.twin.resize(s.num_half_edges());
  b.outgoing.resize(vertices);
  b.degree.resize(vertices);
  r.face_parent.resize(r.faces_from_faces);
  const auto set = [&](Index at, const Index(&tails)[3], const Index(&twins)[3], Face parent) {
    std::copy_n(tails, 3, &b.tail[at]);
    std::copy_n(twins, 3, &b.twin[at]);
    r.face_parent[at / 3] = index(parent);
  };
  parallel_for(t.num_half_edges(), [&](std::int64_t i) {
    const HalfEdge h{static_cast<Index>(i)}, g = t.twin(h);
    const Index tail = index(t.tail(h)), head = index(t.head(h)), at = s.first(h);
    const Face f = t.face(h);
    if (exists(g))
      return set(at, {tail, s.point(g), s.point(h)}, {s.beside_head(g), s.first(g) + 1, s.beside_tail(h)}, f);
    if (!trisects) return set(at, {tail, head, s.point(h)}, {-1, s.beside_head(h), s.beside_tail(h)}, f);
    const Index one = s.third(h, 0), two = s.third(h, 1);
    if (s.border_of[index(f)] >= 0)
      return set(at, {one, two, index(t.tail(t.prev(h)))}, {-1, s.first(t.twin(t.next(h))), s.first(t.prev(h)) + 2}, f);
    const Index point = s.point(h);
    set(at, {tail, one, point}, {-1, at + 5, s.beside_tail(h)}, f);
    set(at + 3, {one, two, point}, {-1, at + 8, at + 1}, f);
    set(at + 6, {two, head, point}, {-1, s.beside_head(h), at + 4}, f);
  });

  // Fans: a vertex has one triangle for each half-edge that leaves it; borders add or take away.
  parallel_for(t.num_vertices(), [&](std::int64_t i) {
    HalfEdge h = t.outgoing(Vertex{Index(i)});
    b.degree[i] = t.num_faces(Vertex{Index(i)});
    b.outgoing[i] = exists(h) ? s.first(h) : -1;
    if (!exists(h) || !s.is_border(h)) return;
    b.degree[i] += 1;
    if (s.border_of[index(t.face(h))] < 0) return;
    b.degree[i] -= 2;
    b.outgoing[i] = s.first(t.twin(t.prev(h)));
  });
  parallel_for(t.num_faces(), [&](std::int64_t i) {
    const Index point = s.point_of[i];
    if (point < 0) return;
    b.outgoing[point] = s.first(t.first(Face{Index(i)})) + 2;
    b.degree[point] = 0;
    for (Index k = 0; k < 3; ++k) {
      const HalfEdge h = t.corner(Face{Index(i)}, k);
      b.degree[point] += s.is_border(h) ? s.triangles(h) : 2;
    }
  });
  for (const Index i : r.borders) {
    const HalfEdge h{i};
    const bool cut = s.border_of[index(t.face(h))] >= 0;
    b.outgoing[s.third(h, 0)] = s.first(h) + (cut ? 0 : 3);
    b.outgoing[s.third(h, 1)] = cut ? s.first(t.next(h)) + 2 : s.first(h) + 6;
    b.degree[s.third(h, 0)] = b.degree[s.third(h, 1)] = cut ? 3 : 2;
    if (cut) ++b.degree[index(t.tail(t.prev(h)))];
  }
  const bool plain = t.is_manifold() && std::ssize(r.face_list) + std::ssize(r.borders) == t.num_faces();
  if ((r.face_list.empty() && t.is_manifold()) || plain) {
    b.uniform_face_size = 3;
  } else {  // sheets that meet in a vertex, faces with several borders
    for (Index f = 0; f <= r.faces_from_faces; ++f) b.face_offsets.push_back(3 * f);
  }
  const bool needs_fans = !b.face_offsets.empty();
  r.topology = built(std::move(b), vertices, needs_fans);
  return r;
}

}  // namespace sublimit
