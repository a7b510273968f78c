// SPDX-License-Identifier: Apache-2.0
#pragma once
// Masks as numbers, one evaluation per type of site. A mask depends on face sizes alone (sharpness is blended outside), so
// a mesh of a million vertices asks a mask a handful of times; `visit_site` goes through a site's vertices in the order of its slots.
#include <algorithm>
#include <map>
#include <vector>

#include "sublimit/mesh/topology.h"
#include "sublimit/sites.h"

namespace sublimit {

template <class T>
class MaskTable {
 public:
  /// Weights by slot.
  struct Weights : std::vector<T> {
    using std::vector<T>::vector;
    bool has_zeros = false;
  };

  MaskTable(const Masks<T>& masks, int level) : masks_(&masks), level_(level) {}

  const Weights& face(Index size) {
    Weights& weights = at(faces_, size);
    if (weights.empty()) {
      std::vector<Index> slots(size);
      for (Index i = 0; i < size; ++i) slots[i] = i;
      weights = dense(masks_->face(FaceSite<T>(*masks_, level_, slots)), size);
    }
    return weights;
  }

  const Weights& edge(Index left_size, Index right_size) {
    Weights& weights = edges_[{left_size, right_size}];
    if (weights.empty())
      weights = dense(masks_->edge(EdgeSite<T>(*masks_, level_, left_size, right_size)), left_size + right_size - 2);
    return weights;
  }

  const Weights& vertex(const std::vector<Index>& face_sizes) {
    Weights& weights = vertices_[face_sizes];
    if (weights.empty()) {
      Index slots = 1;
      for (const Index size : face_sizes) slots += size - 2;
      weights = dense(masks_->vertex(Ring<T>(*masks_, level_, face_sizes)), slots);
    }
    return weights;
  }

  /// Where all faces of a mesh have one size, types are found without a search.
  const Weights& vertex(Index valence, Index face_size) {
    Weights& weights = at(rings_, valence);
    if (weights.empty()) weights = vertex(std::vector<Index>(valence, face_size));
    return weights;
  }
  const Weights& uniform_edge(Index face_size) {
    if (!uniform_edge_) uniform_edge_ = &edge(face_size, face_size);
    return *uniform_edge_;
  }

 private:
  static Weights& at(std::vector<Weights>& list, Index i) {
    if (static_cast<size_t>(i) >= list.size()) list.resize(i + 1);
    return list[i];
  }
  static Weights dense(const Stencil<T>& stencil, Index slots) {
    Weights weights(slots, T(0));
    for (const auto& [slot, weight] : stencil.terms()) weights[slot] = weight;
    weights.has_zeros = std::find(weights.begin(), weights.end(), T(0)) != weights.end();
    return weights;
  }

  const Masks<T>* masks_;
  int level_;
  std::vector<Weights> faces_;
  std::map<std::pair<Index, Index>, Weights> edges_;
  std::map<std::vector<Index>, Weights> vertices_;
  std::vector<Weights> rings_;
  const Weights* uniform_edge_ = nullptr;
};

/// Calls visit(vertex) for the vertices of a face, in the order of FaceSite's slots.
template <class Visit>
void visit_site(const Topology& t, Face f, const Visit& visit) {
  for (const Index v : t.vertices(f)) visit(v);
}

/// The same around an interior edge, in the order of EdgeSite's slots.
template <class Visit>
void visit_site(const Topology& t, Edge e, const Visit& visit) {
  const HalfEdge left = t.half_edge(e), right = t.twin(left);
  visit(index(t.tail(left)));
  visit(index(t.tail(right)));
  for (const HalfEdge side : {left, right})
    for (HalfEdge h = t.next(t.next(side)); h != side; h = t.next(h)) visit(index(t.tail(h)));
}

/// The same around an interior vertex, in the order of Ring's slots.
template <class Visit>
void visit_site(const Topology& t, Vertex v, const Visit& visit) {
  visit(index(v));
  const HalfEdge start = t.outgoing(v);
  HalfEdge h = start;
  do {
    const HalfEdge last = t.prev(h);
    for (HalfEdge g = t.next(h); g != last; g = t.next(g)) visit(index(t.tail(g)));
    h = t.twin(last);
  } while (h != start);
}

/// Sizes of the faces around an interior vertex.
inline void face_sizes_around(const Topology& t, Vertex v, std::vector<Index>& sizes) {
  sizes.clear();
  HalfEdge h = t.outgoing(v);
  do {
    sizes.push_back(t.size(t.face(h)));
    h = t.ccw(h);
  } while (h != t.outgoing(v));
}

}  // namespace sublimit
