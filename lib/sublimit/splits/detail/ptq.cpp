// SPDX-License-Identifier: Apache-2.0
// Primal triangular split. Triangle f = (v0 v1 v2) with midpoints m_i of the edges (v_i, v_i+1) becomes
//   4f: (v0 m0 m2)   4f+1: (m0 v1 m1)   4f+2: (m2 m1 v2)   4f+3: (m1 m2 m0)
// so that the corner children are oriented as their parent.
#include <utility>

#include "sublimit/splits/detail/primal.h"
#include "sublimit/splits/detail/sheets.h"

namespace sublimit {
namespace {

// Child half-edge that runs along the first half of corner i of face f, and along the second half (in the child at
// corner i + 1). Corner i of the child at corner i is its vertex. Function objects, not functions: PrimalHalves calls
// them inline.
constexpr auto first_half = [](Index h) { return 12 * (h / 3) + 4 * (h % 3); };
constexpr auto second_half = [](Index h) { return 12 * (h / 3) + 3 * ((h + 1) % 3) + h % 3; };
// From the midpoint of corner i's edge, in the child at corner i.
constexpr auto inner_half = [](Index h) { return 12 * (h / 3) + 3 * (h % 3) + (h + 1) % 3; };

/// Corners of the four children of a face.
void set_tails(const Topology& parent, const Refinement& r, Index f, std::span<Index> tail) {
  Index m[3];
  for (Index k = 0; k < 3; ++k) m[k] = index(r.child(parent.edge(HalfEdge{3 * f + k})));
  for (Index k = 0; k < 3; ++k) {
    // Child k: its vertex at position k, m_k at k + 1, m_k-1 at k + 2. The middle triangle has m_k+1 at position k.
    const Index child = 12 * f + 3 * k, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    tail[child + k] = index(parent.tail(HalfEdge{3 * f + k}));
    tail[child + k1] = m[k];
    tail[child + k2] = m[k2];
    tail[12 * f + 9 + k] = m[k1];
  }
}

}  // namespace

std::pair<HalfEdge, HalfEdge> ptq_halves(const Topology&, HalfEdge h) {
  return {HalfEdge{first_half(index(h))}, HalfEdge{second_half(index(h))}};
}

Refinement ptq_numbering(const Topology& parent) {
  check_triangles(parent);
  Refinement r;
  r.split = Split::ptq;
  r.from_vertices = parent.num_vertices();
  r.from_edges = parent.num_edges();
  return r;
}

void set_ptq_corners(const Topology& parent, const Refinement& numbering, std::span<Index> corners) {
  parallel_for(parent.num_faces(),
               [&](std::int64_t f) { set_tails(parent, numbering, static_cast<Index>(f), corners); });
}

Refinement refine_ptq(const Topology& parent) {
  Refinement r = ptq_numbering(parent);
  const size_t num_vertices = size_t(r.from_vertices) + r.from_edges;

  TopologyBuilder b;
  b.uniform_face_size = 3;
  b.tail.resize(12 * size_t(parent.num_faces()));
  b.twin.resize(b.tail.size());
  b.outgoing.resize(num_vertices);
  b.degree.resize(num_vertices);
  r.face_parent.resize(4 * size_t(parent.num_faces()));

  const PrimalHalves halves(parent, first_half, second_half, inner_half);
  parallel_for(parent.num_faces(), [&](std::int64_t i) {
    const Index f = static_cast<Index>(i), middle = 12 * f + 9;
    set_tails(parent, r, f, b.tail);
    for (Index k = 0; k < 3; ++k) {
      const Index child = 12 * f + 3 * k, k1 = (k + 1) % 3;
      // The side m_k -> m_k-1 of child k meets the middle's side m_k-1 -> m_k, which starts at position k + 1.
      b.twin[child + k1] = middle + k1;
      b.twin[middle + k1] = child + k1;
      halves.set_twins(3 * f + k, b.twin);
      r.face_parent[4 * f + k] = f;
    }
    r.face_parent[4 * f + 3] = f;
  });
  halves.set_fans(b, r, 3);
  halves.set_nonmanifold(b, r);

  r.topology = std::move(b).build();
  return r;
}

}  // namespace sublimit
