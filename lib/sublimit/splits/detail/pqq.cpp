// SPDX-License-Identifier: Apache-2.0
// Primal quadrilateral split. Corner h of a face becomes child face h, with the four half-edges
//   side 0: vertex -> midpoint of edge(h)        side 1: midpoint of edge(h) -> face point
//   side 2: face point -> midpoint of edge(prev h)   side 3: midpoint of edge(prev h) -> vertex
// stored from position rotation(h) on, so that the children of a quad are oriented as their parent.
#include <array>
#include <utility>

#include "sublimit/splits/detail/primal.h"

namespace sublimit {
namespace {

struct Pqq {
  const Topology& t;
  Index rotation(Index h) const {
    const Face f = t.face(HalfEdge{h});
    return t.size(f) == 4 ? h - index(t.first(f)) : 0;
  }
  Index side(Index h, Index k) const { return 4 * h + ((k + rotation(h)) & 3); }
  Index first_half(Index h) const { return side(h, 0); }
  Index second_half(Index h) const { return side(index(t.next(HalfEdge{h})), 3); }
};

/// The four corners of child face h, by sides.
void set_tails(std::span<Index> tail, Index h, Index rotation, const std::array<Index, 4>& by_side) {
  for (Index side = 0; side < 4; ++side) tail[4 * h + ((side + rotation) & 3)] = by_side[side];
}

}  // namespace

std::pair<HalfEdge, HalfEdge> pqq_halves(const Topology& parent, HalfEdge h) {
  const Pqq pqq{parent};
  return {HalfEdge{pqq.first_half(index(h))}, HalfEdge{pqq.second_half(index(h))}};
}

Refinement pqq_numbering(const Topology& parent) {
  Refinement r;
  r.split = Split::pqq;
  r.from_vertices = parent.num_vertices();
  r.from_faces = parent.num_faces();
  r.from_edges = parent.num_edges();
  return r;
}

void set_pqq_corners(const Topology& parent, const Refinement& numbering, std::span<Index> corners) {
  parallel_for(parent.num_faces(), [&](std::int64_t i) {
    const Face f{static_cast<Index>(i)};
    const Index n = parent.size(f), begin = index(parent.first(f)), face_point = index(numbering.child(f));
    Index before = index(numbering.child(parent.edge(HalfEdge{begin + n - 1})));
    for (Index k = 0; k < n; ++k) {
      const Index h = begin + k, after = index(numbering.child(parent.edge(HalfEdge{h})));
      set_tails(corners, h, n == 4 ? k : 0, {index(parent.tail(HalfEdge{h})), after, face_point, before});
      before = after;
    }
  });
}

Refinement refine_pqq(const Topology& parent) {
  const Pqq pqq{parent};
  const Index corners = parent.num_half_edges();
  Refinement r = pqq_numbering(parent);
  const size_t num_vertices = size_t(r.from_vertices) + r.from_faces + r.from_edges;

  TopologyBuilder b;
  b.uniform_face_size = 4;
  b.tail.resize(4 * size_t(corners));
  b.twin.resize(4 * size_t(corners));
  b.outgoing.resize(num_vertices);
  b.degree.resize(num_vertices);
  r.face_parent.resize(corners);

  const PrimalHalves halves(
      parent, [&](Index h) { return pqq.first_half(h); }, [&](Index h) { return pqq.second_half(h); },
      [&](Index h) { return pqq.side(h, 1); });

  parallel_for(parent.num_faces(), [&](std::int64_t i) {
    const Face f{static_cast<Index>(i)};
    const Index n = parent.size(f), begin = index(parent.first(f));
    const Index face_point = index(r.child(f));
    for (Index k = 0; k < n; ++k) {
      const Index h = begin + k, next = begin + (k + 1 == n ? 0 : k + 1), prev = begin + (k == 0 ? n - 1 : k - 1);
      const auto twin = [&](Index g) { return index(parent.twin(HalfEdge{g})); };
      const Index first = twin(h), second = twin(prev), rotation = n == 4 ? k : 0;
      set_tails(b.tail, h, rotation,
                {index(parent.tail(HalfEdge{h})), index(r.child(parent.edge(HalfEdge{h}))), face_point,
                 index(r.child(parent.edge(HalfEdge{prev})))});
      const Index twins[] = {first < 0 ? -1 : pqq.second_half(first), pqq.side(next, 2), pqq.side(prev, 1),
                             second < 0 ? -1 : pqq.first_half(second)};
      for (Index side = 0; side < 4; ++side) b.twin[4 * h + ((side + rotation) & 3)] = twins[side];
      r.face_parent[h] = index(f);
    }
    b.outgoing[face_point] = pqq.side(begin, 2);
    b.degree[face_point] = n;
  });
  halves.set_fans(b, r, 2);
  halves.set_nonmanifold(b, r);

  r.topology = std::move(b).build();
  return r;
}

}  // namespace sublimit
