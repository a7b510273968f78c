// SPDX-License-Identifier: Apache-2.0
#pragma once
// Masks as numbers, one evaluation per type of site. A mask depends on face sizes alone (sharpness is blended outside), so
// a mesh of a million vertices asks a mask a handful of times; `gather` collects a site's vertices in the order of its slots.
#include <map>
#include <vector>

#include "sublimit/mesh/topology.h"
#include "sublimit/sites.h"

namespace sublimit {

template <class T>
class MaskTable {
 public:
  /// Weights by slot.
  using Weights = std::vector<T>;

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

  /// The same for a ring of equal faces.
  const Weights& vertex(Index valence, Index face_size) {
    Weights& weights = at(rings_[face_size], valence);
    if (weights.empty()) weights = vertex(std::vector<Index>(valence, face_size));
    return weights;
  }

 private:
  static Weights& at(std::vector<Weights>& list, Index i) {
    if (static_cast<size_t>(i) >= list.size()) list.resize(i + 1);
    return list[i];
  }
  static Weights dense(const Stencil<T>& stencil, Index slots) {
    Weights weights(slots, T(0));
    for (const auto& [slot, weight] : stencil.terms()) weights[slot] = weight;
    return weights;
  }

  const Masks<T>* masks_;
  int level_;
  std::vector<Weights> faces_;
  std::map<std::pair<Index, Index>, Weights> edges_;
  std::map<std::vector<Index>, Weights> vertices_;
  std::map<Index, std::vector<Weights>> rings_;
};

/// Vertices of a face, in the order of FaceSite's slots.
inline void gather(const Topology& t, Face f, std::vector<Index>& slots) {
  const std::span<const Index> corners = t.vertices(f);
  slots.assign(corners.begin(), corners.end());
}

/// Vertices around an interior edge, in the order of EdgeSite's slots.
inline void gather(const Topology& t, Edge e, std::vector<Index>& slots) {
  const HalfEdge left = t.half_edge(e), right = t.twin(left);
  slots.assign({index(t.tail(left)), index(t.tail(right))});
  for (const HalfEdge side : {left, right})
    for (HalfEdge h = t.next(t.next(side)); h != side; h = t.next(h)) slots.push_back(index(t.tail(h)));
}

/// Vertices around an interior vertex, in the order of Ring's slots; `face_sizes`, if given, receives the sizes.
inline void gather(const Topology& t, Vertex v, std::vector<Index>& slots, std::vector<Index>* face_sizes = nullptr) {
  slots.assign({index(v)});
  if (face_sizes) face_sizes->clear();
  const HalfEdge start = t.outgoing(v);
  HalfEdge h = start;
  do {
    const HalfEdge last = t.prev(h);
    for (HalfEdge g = t.next(h); g != last; g = t.next(g)) slots.push_back(index(t.tail(g)));
    if (face_sizes) face_sizes->push_back(t.size(t.face(h)));
    h = t.twin(last);
  } while (h != start);
}

}  // namespace sublimit
