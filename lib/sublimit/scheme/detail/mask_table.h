// SPDX-License-Identifier: Apache-2.0
#pragma once
// Weights of masks, evaluated once per type of site. A mask depends only on face sizes (sharpness is blended
// elsewhere), so masks are called a handful of times for a mesh of a million vertices. `visit_site` visits the
// vertices of a site in the order of its slots.
#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/mesh/topology.h"
#include "sublimit/scheme/detail/check_scheme.h"
#include "sublimit/scheme/sites.h"

namespace sublimit {

/// Weights of one step's masks. One thread at a time.
template <class T>
class MaskTable {
 public:
  /// Weights by slot. If some are zero, `kept` lists the slots of the others.
  struct Weights : std::vector<T> {
    using std::vector<T>::vector;
    std::vector<Index> kept;
    bool has_zeros = false;
    FanShape tail, head;      ///< for a wide edge: the parts of the rings that have weight
    std::vector<T> on_edges;  ///< weights of points on a face's edges and on the edges beyond, if any is not zero
    const T& nonzero(Index i) const { return (*this)[has_zeros ? kept[i] : i]; }
    Index count() const { return static_cast<Index>(has_zeros ? kept.size() : this->size()); }
  };

  /// @param scheme  name of the scheme, for messages; must outlive this, like the masks
  MaskTable(const std::string& scheme, const Masks<T>& masks, int level)
      : scheme_(&scheme), masks_(&masks), level_(level) {}
  MaskTable(const std::string&&, const Masks<T>&, int) = delete;
  MaskTable(const std::string&, const Masks<T>&&, int) = delete;
  MaskTable(const std::string&&, const Masks<T>&&, int) = delete;
  MaskTable(MaskTable&&) = default;
  MaskTable(const MaskTable&) = delete;  // has pointers to its own weights
  MaskTable& operator=(const MaskTable&) = delete;

  const Weights& face(Index size) {
    Weights& weights = at(faces_, size);
    if (weights.empty()) {
      std::vector<Index> slots(size);
      for (Index i = 0; i < size; ++i) slots[i] = i;
      weights = dense("face", masks_->face(FaceSite<T>(*masks_, level_, slots)), size);
    }
    return weights;
  }

  const Weights& corner(Index size) {
    Weights& weights = at(corners_, size);
    if (weights.empty()) {
      std::vector<Index> slots(size);
      for (Index i = 0; i < size; ++i) slots[i] = i;
      weights = dense("corner", masks_->corner(FaceSite<T>(*masks_, level_, slots)), size);
    }
    return weights;
  }

  const Weights& wide_edge(Index face_size, FanShape tail, FanShape head) {
    if (tail.is_closed() && head.is_closed() && tail.faces < 16 && head.faces < 16) {
      const Weights*& known = closed_edges_[tail.faces][head.faces];
      if (!known) known = &wide_edge_of(face_size, tail, head);
      return *known;
    }
    return wide_edge_of(face_size, tail, head);
  }
  const Weights& wide_face(const std::vector<FanShape>& shapes) {
    const FanShape first = shapes[0];
    const bool alike = first.is_closed() && std::count(shapes.begin(), shapes.end(), first) == std::ssize(shapes);
    if (!alike) return wide_face_of(shapes);
    if (static_cast<size_t>(first.faces) >= alike_faces_.size()) alike_faces_.resize(first.faces + 1);
    const Weights*& known = alike_faces_[first.faces];
    if (!known) known = &wide_face_of(shapes);
    return *known;
  }

  const Weights& edge(Index left_size, Index right_size) {
    Weights& weights = edges_[{left_size, right_size}];
    if (weights.empty())
      weights =
          dense("edge", masks_->edge(EdgeSite<T>(*masks_, level_, left_size, right_size)), left_size + right_size - 2);
    return weights;
  }

  /// Returns the weights of a vertex's child; a single weight 1 if the vertex is kept.
  const Weights& vertex(const std::vector<Index>& face_sizes) {
    Weights& weights = vertices_[face_sizes];
    if (weights.empty()) {
      Index slots = 1;
      for (const Index size : face_sizes) slots += size - 2;
      weights = dense("vertex", masks_->vertex(Ring<T>(*masks_, level_, face_sizes)), slots);
      if (weights.kept == std::vector<Index>{0}) weights = finished(Weights(1, weights[0]));
    }
    return weights;
  }

  /// Knots of the edges of a site's faces, face by face.
  using Knots = std::vector<std::vector<EdgeKnots<double>>>;
  /// True if all knot intervals are equal, which masks assume by default.
  static bool are_equal(const Knots& knots, KnotOwner owner = KnotOwner::edge) {
    const double d = knots[0][0].length, before = owner == KnotOwner::edge ? d : d / 2;
    for (const std::vector<EdgeKnots<double>>& face : knots)
      for (const EdgeKnots<double>& k : face)
        if (k.length != d || k.split != d / 2 || k.before != before || k.after != d) return false;
    return true;
  }
  // Sites whose intervals differ: found by their knots. Valid until the next call.
  const Weights& face(const Knots& knots) {
    return known(knots, 'f', [&] { return of_face("face", masks_->face, knots); });
  }
  /// @param knots  of the face from the corner on
  const Weights& corner(const Knots& knots) {
    return known(knots, 'c', [&] { return of_face("corner", masks_->corner, knots); });
  }
  /// @param knots  of the left face from the edge on, then of the right one
  const Weights& edge(const Knots& knots) {
    return known(knots, 'e', [&] {
      const auto left = static_cast<Index>(knots[0].size()), right = static_cast<Index>(knots[1].size());
      return dense("edge", masks_->edge(EdgeSite<T>(*masks_, level_, left, right, cast(knots[0]), cast(knots[1]))),
                   left + right - 2);
    });
  }
  /// @param knots  of each face from the vertex on
  const Weights& vertex(const Knots& knots) {
    return known(knots, 'v', [&] {
      std::vector<Index> sizes;
      std::vector<std::vector<EdgeKnots<T>>> own;
      Index slots = 1;
      for (const std::vector<EdgeKnots<double>>& face : knots) {
        sizes.push_back(static_cast<Index>(face.size()));
        slots += sizes.back() - 2;
        own.push_back(cast(face));
      }
      return dense("vertex", masks_->vertex(Ring<T>(*masks_, level_, sizes, std::move(own))), slots);
    });
  }

  /// Index of types for meshes whose faces all have one size, which saves a search.
  const Weights& vertex(Index valence, Index face_size) {
    Weights& weights = at(rings_, valence);
    if (weights.empty()) weights = vertex(std::vector<Index>(valence, face_size));
    return weights;
  }
  const Weights& uniform_edge(Index face_size) {
    if (!uniform_edge_) uniform_edge_ = &edge(face_size, face_size);
    return *uniform_edge_;
  }

  static EdgeKnots<T> cast(const EdgeKnots<double>& k) {
    return {number(k.length), number(k.split), number(k.before), number(k.after)};
  }

 private:
  Weights of_face(const char* name, const Mask<T, FaceSite<T>>& mask, const Knots& knots) {
    const auto size = static_cast<Index>(knots[0].size());
    std::vector<Index> slots(size);
    for (Index i = 0; i < size; ++i) slots[i] = i;
    return dense(name, mask(FaceSite<T>(*masks_, level_, slots, cast(knots[0]))), size);
  }
  static T number(double x) {
    if constexpr (std::is_constructible_v<T, double>)
      return T(x);
    else
      throw InvalidParameter("knot intervals are floating-point numbers; this type of numbers has none");
  }
  static std::vector<EdgeKnots<T>> cast(const std::vector<EdgeKnots<double>>& knots) {
    std::vector<EdgeKnots<T>> result;
    for (const EdgeKnots<double>& k : knots) result.push_back(cast(k));
    return result;
  }
  template <class Make>
  const Weights& known(const Knots& knots, char kind, const Make& make) {
    key_.assign(1, kind);
    for (const std::vector<EdgeKnots<double>>& face : knots) {
      key_.push_back(static_cast<double>(face.size()));
      for (const EdgeKnots<double>& k : face) key_.insert(key_.end(), {k.length, k.split, k.before, k.after});
    }
    constexpr size_t enough = 4096;
    if (by_knots_.size() > enough) by_knots_.clear();
    Weights& weights = by_knots_[key_];
    if (weights.empty()) weights = make();
    return weights;
  }
  static Weights& at(std::vector<Weights>& list, Index i) {
    if (static_cast<size_t>(i) >= list.size()) list.resize(i + 1);
    return list[i];
  }
  /// Returns the weights of a stencil by slot.
  /// @throws InvalidParameter  see `check_weights`
  Weights dense(const char* mask, const Stencil<T>& stencil, Index slots) const {
    check_weights(*scheme_, mask, stencil, slots);
    Weights weights(slots, T(0));
    for (const auto& [slot, weight] : stencil.terms()) weights[slot] = weight;
    return finished(std::move(weights));
  }
  static Weights finished(Weights weights) {
    weights.kept.clear();
    for (size_t i = 0; i < weights.size(); ++i)
      if (weights[i] != T(0)) weights.kept.push_back(static_cast<Index>(i));
    weights.has_zeros = weights.kept.size() < weights.size();
    return weights;
  }

  const Weights& wide_edge_of(Index face_size, FanShape tail, FanShape head) {
    Weights& weights = wide_edges_[{tail, head}];
    if (weights.empty()) {
      const auto site = [&] { return WideEdgeSite<T>(*masks_, level_, face_size, tail, head); };
      Weights all = dense("wide_edge", masks_->wide_edge(site()), site().num_slots());
      // Points of a ring that have no weight need no visit. The head's stand last, the tail's behind the edge's own
      // faces.
      const auto leave_out = [&](FanShape& ring, auto first) {
        const FanShape known = ring;
        if (!known.is_closed()) return;
        ring = {2, -1};
        const Index kept = site().num_slots(), count = static_cast<Index>(all.size()) - kept;
        const auto begin = first(count);
        if (std::all_of(begin, begin + count, [](const T& w) { return w == T(0); })) {
          all.erase(begin, begin + count);
        } else {
          ring = known;
        }
      };
      leave_out(head, [&](Index count) { return all.end() - count; });
      leave_out(tail, [&](Index) { return all.begin() + 2 * (face_size - 1); });
      weights = finished(std::move(all));
      weights.tail = tail;
      weights.head = head;
    }
    return weights;
  }

  const Weights& wide_face_of(const std::vector<FanShape>& shapes) {
    Weights& weights = wide_faces_[shapes];
    if (weights.empty()) {
      const WideFaceSite<T> site(*masks_, level_, shapes);
      Weights all =
          dense("wide_face", masks_->wide_face(site), site.num_slots() + 2 * static_cast<Index>(shapes.size()));
      std::vector<T> on_edges(all.begin() + site.num_slots(), all.end());
      all.resize(site.num_slots());
      weights = finished(std::move(all));
      if (std::any_of(on_edges.begin(), on_edges.end(), [](const T& w) { return w != T(0); }))
        weights.on_edges = std::move(on_edges);
    }
    return weights;
  }

  const std::string* scheme_;
  const Masks<T>* masks_;
  int level_;
  std::vector<const Weights*> alike_faces_;
  std::map<std::pair<FanShape, FanShape>, Weights> wide_edges_;
  std::map<std::vector<FanShape>, Weights> wide_faces_;
  const Weights* closed_edges_[16][16] = {};
  std::vector<Weights> corners_;
  std::vector<Weights> faces_;
  std::map<std::pair<Index, Index>, Weights> edges_;
  std::map<std::vector<Index>, Weights> vertices_;
  std::vector<Weights> rings_;
  const Weights* uniform_edge_ = nullptr;
  std::map<std::vector<double>, Weights> by_knots_;
  std::vector<double> key_;
};

/// Connectivity of faces of a size known at compile time, as `visit_site` needs it, without divisions or
/// branches.
template <Index N>
class UniformFaces {
 public:
  /// @param t  must outlive this
  explicit UniformFaces(const Topology&& t) = delete;
  explicit UniformFaces(const Topology& t) : t_(t), tails_(t.num_faces() > 0 ? t.vertices(Face{0}).data() : nullptr) {}
  Index size(Face) const { return N; }
  Face face(HalfEdge h) const { return Face{index(h) / N}; }
  Index corner_index(HalfEdge h) const { return index(h) % N; }
  std::span<const Index> vertices(Face f) const { return {tails_ + N * std::ptrdiff_t(index(f)), size_t(N)}; }
  Vertex tail(HalfEdge h) const { return Vertex{tails_[index(h)]}; }
  HalfEdge twin(HalfEdge h) const { return t_.twin(h); }
  HalfEdge ccw(HalfEdge h) const { return t_.twin(HalfEdge{index(h) % N == 0 ? index(h) + N - 1 : index(h) - 1}); }
  HalfEdge half_edge(Edge e) const { return t_.half_edge(e); }
  HalfEdge outgoing(Vertex v) const { return t_.outgoing(v); }

 private:
  const Topology& t_;
  const Index* tails_;
};

/// Calls visit(vertex) for the corners of a half-edge's face, from the `skip`-th after the half-edge's own on, `count`
/// of them.
template <class Connectivity, class Visit>
[[gnu::always_inline]] inline void visit_corners(const Connectivity& t, HalfEdge h, Index skip, Index count,
                                                 const Visit& visit) {
  const std::span<const Index> corners = t.vertices(t.face(h));
  const Index size = static_cast<Index>(corners.size());
  Index i = t.corner_index(h) + skip;
  if (i >= size) i -= size;
  for (Index k = 0; k < count; ++k) {
    visit(corners[i]);
    if (++i == size) i = 0;
  }
}

/// Calls visit(vertex) for the vertices of a face, in the order of FaceSite's slots.
template <class Connectivity, class Visit>
[[gnu::always_inline]] inline void visit_site(const Connectivity& t, Face f, const Visit& visit) {
  for (const Index v : t.vertices(f)) visit(v);
}

/// Visits the vertices around an interior edge, in the order of EdgeSite's slots.
template <class Connectivity, class Visit>
[[gnu::always_inline]] inline void visit_site(const Connectivity& t, Edge e, const Visit& visit) {
  const HalfEdge left = t.half_edge(e), right = t.twin(left);
  visit(index(t.tail(left)));
  visit(index(t.tail(right)));
  for (const HalfEdge side : {left, right}) visit_corners(t, side, 2, t.size(t.face(side)) - 2, visit);
}

/// Visits the vertices around an interior vertex, in the order of Ring's slots.
template <class Connectivity, class Visit>
[[gnu::always_inline]] inline void visit_site(const Connectivity& t, Vertex v, const Visit& visit) {
  visit(index(v));
  const HalfEdge start = t.outgoing(v);
  HalfEdge h = start;
  do {
    visit_corners(t, h, 1, t.size(t.face(h)) - 2, visit);
    h = t.ccw(h);
  } while (h != start);
}

/// Visits the vertices of a face from a corner on, in the order of FaceSite's slots.
template <class Connectivity, class Visit>
[[gnu::always_inline]] inline void visit_site(const Connectivity& t, HalfEdge corner, const Visit& visit) {
  visit_corners(t, corner, 0, t.size(t.face(corner)), visit);
}

/// Returns the shape of the fan at the tail of a half-edge.
/// @param is_cut  is_cut(half-edge) is true where rings are cut: at the boundary and along sharp edges
template <class IsCut>
FanShape fan_shape(const Topology& t, HalfEdge h, const IsCut& is_cut) {
  FanShape shape{1, -1};
  HalfEdge g = h;  // faces on the left, counter-clockwise
  for (;;) {
    const HalfEdge into = t.prev(g);
    if (is_cut(into)) break;
    g = t.twin(into);
    if (g == h) return shape;
    ++shape.faces;
  }
  shape.start = 0;
  for (g = h; !is_cut(g); ++shape.faces, ++shape.start) g = t.next(t.twin(g));
  return shape;
}

/// Calls visit(vertex) for the vertices that a ring adds to those of the site's own faces, counter-clockwise.
/// @param first       half-edge of the first face, whose tail is the vertex of the ring
/// @param count       number of faces
/// @param ends_known  true: the far end of the last face has a slot already
template <class Visit>
void visit_faces_ccw(const Topology& t, HalfEdge first, Index count, bool ends_known, const Visit& visit) {
  HalfEdge h = first;
  for (Index k = 0; k < count; ++k) {
    const bool end_known = ends_known && k + 1 == count;
    visit_corners(t, h, 2, t.size(t.face(h)) - (end_known ? 3 : 2), visit);
    if (k + 1 < count) h = t.ccw(h);
  }
}
/// Likewise clockwise: `first` is the half-edge of the face nearest to the site. Each face has its corners in
/// the order from its first edge.
template <class Visit>
void visit_faces_cw(const Topology& t, HalfEdge first, Index count, const Visit& visit) {
  HalfEdge h = first;
  for (Index k = 0; k < count; ++k) {
    visit_corners(t, h, 1, t.size(t.face(h)) - 2, visit);
    if (k + 1 < count) h = t.next(t.twin(h));
  }
}

/// Calls visit(vertex) around an edge in the order of WideEdgeSite's slots; `left` runs along the edge, its face is the
/// left one.
template <class Visit>
void visit_wide_edge(const Topology& t, HalfEdge left, FanShape tail, FanShape head, const Visit& visit) {
  const bool has_right = tail.is_closed() || tail.right() > 0;
  const HalfEdge right = has_right ? t.twin(left) : no_half_edge;
  visit(index(t.tail(left)));
  visit(index(t.head(left)));
  visit_corners(t, left, 2, t.size(t.face(left)) - 2, visit);
  if (has_right) visit_corners(t, right, 2, t.size(t.face(right)) - 2, visit);
  // The tail has the left face counter-clockwise, the head the right one.
  if (tail.is_closed()) {
    if (tail.faces > 2) visit_faces_ccw(t, t.twin(t.prev(left)), tail.faces - 2, true, visit);
  } else {
    if (tail.left() > 1) visit_faces_ccw(t, t.twin(t.prev(left)), tail.left() - 1, false, visit);
    if (tail.right() > 1) visit_faces_cw(t, t.next(t.twin(t.next(right))), tail.right() - 1, visit);
  }
  if (head.is_closed()) {
    if (head.faces > 2) visit_faces_ccw(t, t.twin(t.prev(right)), head.faces - 2, true, visit);
  } else {
    if (head.left() > 1) visit_faces_ccw(t, t.twin(t.prev(right)), head.left() - 1, false, visit);
    if (head.right() > 1) visit_faces_cw(t, t.next(t.twin(t.next(left))), head.right() - 1, visit);
  }
}

/// Visits the vertices around a face, in the order of WideFaceSite's slots, without the points on edges.
template <class Visit>
void visit_wide_face(const Topology& t, Face f, const std::vector<FanShape>& shapes, const Visit& visit) {
  const Index size = t.size(f);
  for (const Index v : t.vertices(f)) visit(v);
  for (Index i = 0; i < size; ++i) {
    if (!shapes[i].is_closed() && shapes[i].right() == 0) continue;
    visit_corners(t, t.twin(t.corner(f, i)), 2, size - 2, visit);
  }
  for (Index i = 0; i < size; ++i) {
    const FanShape& shape = shapes[i];
    const HalfEdge own = t.corner(f, i);
    if (shape.is_closed()) {
      if (shape.faces > 3) visit_faces_ccw(t, t.ccw(t.ccw(own)), shape.faces - 3, true, visit);
      continue;
    }
    if (shape.left() > 2) visit_faces_ccw(t, t.ccw(t.ccw(own)), shape.left() - 2, false, visit);
    if (shape.right() > 1) visit_faces_cw(t, t.next(t.twin(t.next(t.twin(own)))), shape.right() - 1, visit);
  }
}

/// Returns the sizes of the faces around an interior vertex.
inline void face_sizes_around(const Topology& t, Vertex v, std::vector<Index>& sizes) {
  sizes.clear();
  HalfEdge h = t.outgoing(v);
  do {
    sizes.push_back(t.size(t.face(h)));
    h = t.ccw(h);
  } while (h != t.outgoing(v));
}

}  // namespace sublimit
