// SPDX-License-Identifier: Apache-2.0
#pragma once
// Common code of the dual splits and sqrt3, which treat a mesh as separate sheets: edges without twins are
// borders, a non-manifold edge is a border of each of its faces, and the faces around a vertex form fans.
#include <algorithm>
#include <vector>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/mesh/detail/topology_builder.h"
#include "sublimit/splits/split.h"

namespace sublimit {

Refinement refine_dqq(const Topology& parent);
Refinement refine_mid_edge(const Topology& parent, int level);
Refinement refine_sqrt3(const Topology& parent, int level);
Refinement refine_dual(const Topology& parent);
Refinement refine_quads(const Topology& parent);
Refinement refine_keep(const Topology& parent);

class Sheets {
 public:
  /// @param topology  must outlive this
  explicit Sheets(const Topology&& topology) = delete;
  explicit Sheets(const Topology& topology) : t_(topology) {
    const Index edges = t_.num_edges();
    cut_.assign(t_.num_half_edges(), -1);
    if (t_.is_manifold()) {
      parallel_for(edges, [&](std::int64_t e) { number(t_.half_edge(Edge{Index(e)}), Index(e)); });
      num_cut_edges_ = edges;
    } else {
      for (Index e = 0; e < edges; ++e)
        for (const HalfEdge h : t_.half_edges(Edge{e}))
          if (cut_[index(h)] < 0) {
            number(h, num_cut_edges_++);
            edge_list_.push_back(e);
          }
    }
    border_rank_.resize(t_.num_half_edges());
    for (Index h = 0; h < t_.num_half_edges(); ++h) {
      border_rank_[h] = static_cast<Index>(borders_.size());
      if (!exists(t_.twin(HalfEdge{h}))) borders_.push_back(h);
    }
    fan_start_.reserve(t_.num_vertices());
    for (Index v = 0; v < t_.num_vertices(); ++v) {
      if (const HalfEdge h = t_.outgoing(Vertex{v}); exists(h)) {
        add_fan(h, t_.num_faces(Vertex{v}));
        continue;
      }
      for (const HalfEdge start : t_.fans(Vertex{v})) {
        Index count = 0;
        HalfEdge h = start;
        do {
          ++count;
          h = t_.ccw(h);
        } while (exists(h) && h != start);
        add_fan(start, count);
      }
    }
  }

  /// Edges, those without twins once for each half-edge; where these are edges of the mesh, edge_list is empty.
  Index cut_edge(HalfEdge h) const { return cut_[index(h)]; }
  Index num_cut_edges() const { return num_cut_edges_; }
  const std::vector<Index>& edge_list() const { return edge_list_; }

  /// Half-edges without twin, ascending, and how many come before a given one.
  const std::vector<Index>& borders() const { return borders_; }
  Index border_rank(HalfEdge h) const { return border_rank_[index(h)]; }

  /// Faces around vertices: start half-edge (the border one, if any) and number of faces.
  Index num_fans() const { return static_cast<Index>(fan_start_.size()); }
  HalfEdge fan_start(Index fan) const { return HalfEdge{fan_start_[fan]}; }
  Index fan_size(Index fan) const { return fan_size_[fan]; }
  bool is_open(Index fan) const { return !exists(t_.twin(fan_start(fan))); }

 private:
  void number(HalfEdge h, Index cut) {
    cut_[index(h)] = cut;
    if (exists(t_.twin(h))) cut_[index(t_.twin(h))] = cut;
  }
  void add_fan(HalfEdge start, Index count) {
    fan_start_.push_back(index(start));
    fan_size_.push_back(count);
  }

  const Topology& t_;
  UninitializedVector<Index> cut_, border_rank_;
  Index num_cut_edges_ = 0;
  std::vector<Index> edge_list_, borders_, fan_start_, fan_size_;
};

/// Makes the topology from the arrays of children. If sheets meet in a vertex, fans are found by a slower
/// search.
inline Topology built(TopologyBuilder&& b, Index num_vertices, bool needs_fans) {
  if (needs_fans) b.find_fans(num_vertices);
  return std::move(b).build();
}

}  // namespace sublimit
