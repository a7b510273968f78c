// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/detail/face_owners.h"

#include "sublimit/base/detail/parallel_for.h"

namespace sublimit {
namespace {

/// The half-edge whose face has the points of an edge, and that whose face has the point of a vertex.
struct Owners {
  std::vector<HalfEdge> edge, vertex;
};

Owners first_owners(const Topology& t) {
  Owners owners{std::vector<HalfEdge>(t.num_edges(), no_half_edge),
                std::vector<HalfEdge>(t.num_vertices(), no_half_edge)};
  for (Index e = 0; e < t.num_edges(); ++e) owners.edge[e] = t.half_edge(Edge{e});
  for (Index h = t.num_half_edges(); h-- > 0;) owners.vertex[index(t.tail(HalfEdge{h}))] = HalfEdge{h};
  return owners;
}

/// Rows of quadrilaterals, each face beside the opposite side of the one before, have their sides in one sense: of
/// every face the one in front. A face is in two rows.
void own_sides_in_front(const Topology& t, std::vector<HalfEdge>& owner) {
  std::vector<std::uint8_t> seen(t.num_faces(), 0);  // by bits: the row through sides 0 and 2, through 1 and 3
  const auto bit = [&](HalfEdge h) { return std::uint8_t(1 << (t.corner_index(h) & 1)); };
  const auto opposite = [&](HalfEdge h) { return t.next(t.next(h)); };
  for (Index f = 0; f < t.num_faces(); ++f)
    for (int k = 0; k < 2; ++k) {
      HalfEdge front = t.corner(Face{f}, k);
      if (seen[f] & bit(front)) continue;
      // Back to where the row begins, if it does.
      for (HalfEdge back = t.twin(opposite(front)); exists(back); back = t.twin(opposite(back))) {
        if (index(t.face(back)) == f && (t.corner_index(back) & 1) == k) break;
        front = back;
      }
      for (; exists(front); front = opposite(t.twin(front))) {
        std::uint8_t& own = seen[index(t.face(front))];
        if (own & bit(front)) break;
        own |= bit(front);
        if (!exists(t.twin(front))) break;
        owner[index(t.edge(front))] = front;
      }
    }
}

Owners balanced_owners(const Topology& t, int sides) {
  Owners owners = first_owners(t);
  std::vector<std::uint8_t> load(t.num_faces(), 0);  // sides that a face has
  if (sides == 4) {
    own_sides_in_front(t, owners.edge);
  } else {
    for (Index e = 0; e < t.num_edges(); ++e) {
      const HalfEdge h = t.half_edge(Edge{e}), other = t.twin(h);
      if (exists(other) && load[index(t.face(other))] < load[index(t.face(h))]) owners.edge[e] = other;
      ++load[index(t.face(owners.edge[e]))];
    }
  }
  // The corner between two sides that a face has, then the face at a vertex that has least.
  const auto has = [&](HalfEdge h) { return owners.edge[index(t.edge(h))] == h; };
  std::vector<std::uint8_t> points(t.num_faces(), 0);
  std::vector<bool> taken(t.num_vertices(), false);
  for (Index h = 0; h < t.num_half_edges(); ++h) {
    const HalfEdge out{h};
    const Index v = index(t.tail(out)), f = index(t.face(out));
    points[f] = static_cast<std::uint8_t>(points[f] + 2 * has(out));
    if (taken[v] || (points[f] & 1) != 0 || !has(out) || !has(t.prev(out))) continue;
    taken[v] = true;
    owners.vertex[v] = out;
    points[f] |= 1;
  }
  for (Index v = 0; v < t.num_vertices(); ++v) {
    if (taken[v] || !exists(owners.vertex[v]) || t.is_nonmanifold(Vertex{v})) continue;
    const HalfEdge first = t.outgoing(Vertex{v});
    HalfEdge best = first;
    for (HalfEdge h = first;;) {
      if (points[index(t.face(h))] < points[index(t.face(best))]) best = h;
      h = t.ccw(h);
      if (!exists(h) || h == first) break;
    }
    owners.vertex[v] = best;
    ++points[index(t.face(best))];
  }
  return owners;
}

}  // namespace

FaceLattices::Arrays face_owners(const Topology& t, const Lattice& lattice, std::span<const std::int8_t> turn,
                                 OwnerRule rule) {
  const int sides = lattice.num_sides();
  const size_t all = size_t(t.num_faces()) * size_t(sides);
  const Owners owners = rule == OwnerRule::first ? first_owners(t) : balanced_owners(t, sides);
  std::vector<std::int32_t> side_faces(all), corner_faces(all);
  std::vector<std::uint8_t> side_places(all), corner_places(all);
  const auto side = [&](HalfEdge h) { return (t.corner_index(h) - turn[index(t.face(h))] + sides) % sides; };
  parallel_for(t.num_faces(), [&](std::int64_t f) {
    const Face face{static_cast<Index>(f)};
    for (int k = 0; k < sides; ++k) {
      const HalfEdge h = t.corner(face, (turn[f] + k) % sides);
      const size_t at = size_t(f) * size_t(sides) + size_t(k);
      const HalfEdge first = owners.edge[index(t.edge(h))];
      // Twins run against each other, other half-edges of a non-manifold edge perhaps.
      const bool against = first != h && (t.twin(h) == first || t.tail(h) != t.tail(first));
      side_faces[at] = index(t.face(first));
      side_places[at] = static_cast<std::uint8_t>(side(first) + (against ? 8 : 0));
      const HalfEdge leaving = owners.vertex[index(t.tail(h))];
      corner_faces[at] = index(t.face(leaving));
      corner_places[at] = static_cast<std::uint8_t>(side(leaving));
    }
  });
  FaceLattices::Arrays arrays;
  arrays.lattice = lattice;
  arrays.side_faces = std::move(side_faces);
  arrays.side_places = std::move(side_places);
  arrays.corner_faces = std::move(corner_faces);
  arrays.corner_places = std::move(corner_places);
  return arrays;
}

}  // namespace sublimit
