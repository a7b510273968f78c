// SPDX-License-Identifier: Apache-2.0
#pragma once
// Common code of the primal splits. Vertices and edges survive (an edge as two halves), so twins, fans and
// non-manifold elements of children are computed from those of parents by arithmetic.
#include <algorithm>
#include <span>
#include <vector>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/mesh/detail/topology_builder.h"
#include "sublimit/splits/split.h"

namespace sublimit {

Refinement refine_pqq(const Topology& parent);
Refinement refine_ptq(const Topology& parent);
Refinement pqq_numbering(const Topology& parent);
Refinement ptq_numbering(const Topology& parent);
void set_pqq_corners(const Topology& parent, const Refinement& numbering, std::span<Index> corners);
void set_ptq_corners(const Topology& parent, const Refinement& numbering, std::span<Index> corners);
std::pair<HalfEdge, HalfEdge> pqq_halves(const Topology& parent, HalfEdge h);
std::pair<HalfEdge, HalfEdge> ptq_halves(const Topology& parent, HalfEdge h);

/// Children of parent half-edges in one primal split: `first(h)` runs along the first half of h (from its vertex),
/// `second(h)` along the second half (to its head), and `inner(h)` from the midpoint into the child at h's vertex.
template <class First, class Second, class Inner>
class PrimalHalves {
 public:
  /// @param parent  must outlive this
  PrimalHalves(const Topology& parent, First first, Second second, Inner inner)
      : t_(parent), first_(first), second_(second), inner_(inner) {}
  PrimalHalves(const Topology&&, First, Second, Inner) = delete;

  /// Sets the twins of the children `first` and `second` of half-edge h.
  void set_twins(Index h, UninitializedVector<Index>& twin) const {
    const Index g = index(t_.twin(HalfEdge{h}));
    twin[first_(h)] = g < 0 ? -1 : second_(g);
    twin[second_(h)] = g < 0 ? -1 : first_(g);
  }

  /// Sets the non-manifold edges and vertices of the child.
  void set_nonmanifold(TopologyBuilder& b, const Refinement& r) const {
    if (t_.is_manifold()) return;
    for (Index e = 0; e < t_.num_edges(); ++e) {
      if (exists(t_.twin(t_.half_edge(Edge{e}))) || !t_.is_nonmanifold(Edge{e})) continue;
      std::vector<Index> at_tail, at_head;
      TopologyBuilder::Fans fans{index(r.child(Edge{e})), {}};
      for (const HalfEdge h : t_.half_edges(Edge{e})) {
        const bool forward = t_.forward(h);
        (forward ? at_tail : at_head).push_back(first_(index(h)));
        (forward ? at_head : at_tail).push_back(second_(index(h)));
        fans.starts.push_back(second_(index(h)));
      }
      for (auto* group : {&at_tail, &at_head}) {
        std::sort(group->begin(), group->end());
        b.nonmanifold_edges.push_back(*group);
      }
      b.nonmanifold_vertices.push_back(std::move(fans));
    }
    for (Index v = 0; v < t_.num_vertices(); ++v) {
      if (!t_.is_nonmanifold(Vertex{v})) continue;
      TopologyBuilder::Fans fans{v, {}};
      for (const HalfEdge h : t_.fans(Vertex{v})) fans.starts.push_back(first_(index(h)));
      b.nonmanifold_vertices.push_back(std::move(fans));
    }
  }

  /// Sets first half-edge and number of corners of the children of vertices and edges. Interior fans start at
  /// their least half-edge, as in meshes from files, so that sums around a vertex have the same bits.
  /// @param corners_at_edge  number of child corners that one half-edge has at its edge's point
  void set_fans(TopologyBuilder& b, const Refinement& r, Index corners_at_edge) const {
    parallel_for(t_.num_vertices(), [&](std::int64_t i) {
      const Vertex v{static_cast<Index>(i)};
      const HalfEdge h = t_.outgoing(v);
      b.outgoing[i] = exists(h) ? first_(index(h)) : -1;
      b.degree[i] = t_.num_faces(v);
    });
    parallel_for(t_.num_edges(), [&](std::int64_t i) {
      const Edge e{static_cast<Index>(i)};
      const HalfEdge h = t_.half_edge(e);
      const Index child = index(r.child(e));
      const HalfEdge twin = t_.twin(h);
      const bool interior = exists(twin);
      const auto least = [&](HalfEdge side) { return std::min(second_(index(side)), inner_(index(side))); };
      b.outgoing[child] = interior ? std::min(least(h), least(twin)) : second_(index(h));
      b.degree[child] = corners_at_edge * (interior ? 2 : static_cast<Index>(t_.half_edges(e).size()));
    });
  }

 private:
  const Topology& t_;
  First first_;
  Second second_;
  Inner inner_;
};

}  // namespace sublimit
