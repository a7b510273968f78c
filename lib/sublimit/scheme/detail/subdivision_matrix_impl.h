// SPDX-License-Identifier: Apache-2.0
#pragma once
// Assembly of subdivision matrices: first the lengths of rows, then their entries, both in order in parallel
// blocks of rows; without triplets. Smooth rows take their weights from the mask table; the few sharp ones are
// blended from the rules of parent and child.
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <type_traits>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/uninitialized.h"
#include "sublimit/scheme/detail/level_knots.h"
#include "sublimit/scheme/detail/mask_table.h"
#include "sublimit/scheme/subdivision_matrix.h"

namespace sublimit {
namespace assembly {

/// Rows of one step, one at a time. Not shared between threads; the masks it evaluates are pure, so every instance
/// makes the same rows.
template <class T>
class RowMaker {
 public:
  using Term = std::pair<Index, T>;
  using Weights = typename MaskTable<T>::Weights;

  RowMaker(const Scheme<T>& scheme, const Step<T>& step, const Topology& parent, const Refinement& refinement,
           const Sharpness& sharpness, const Sharpness& child_sharpness, int level, const KnotSplit* split,
           const std::vector<std::uint8_t>& is_plain)
      : t_(parent),
        quads_(parent),
        triangles_(parent),
        refinement_(refinement),
        sharpness_(sharpness),
        child_sharpness_(child_sharpness),
        is_plain_(is_plain),
        scheme_(check_scheme(scheme).name),
        masks_(scheme.name, step.masks, level),
        creases_(creases_of(scheme, step)),
        step_masks_(step.masks),
        level_(level) {
    if (split) knots_.emplace(parent, *split);
    const CreaseMasks<T>& creases = creases_;
    if (creases.vertex) crease_vertex_ = dense("crease_vertex", creases.vertex(CreaseSite<T>(step.masks, level)), 3);
    for (const int before : {0, 1})
      for (const int after : {0, 1})
        crease_edge_[before][after] =
            dense("crease_edge", creases.edge(CreaseEdgeSite<T>(step.masks, level, before, after)), 4);
    const auto& all = crease_edge_[1][1];
    crease_is_wide_ = all[2] != T(0) || all[3] != T(0);
    wide_edge_ = static_cast<bool>(step.masks.wide_edge);
    wide_face_ = static_cast<bool>(step.masks.wide_face);
    wide_borders_ = step.masks.wide_borders;
  }

  /// Number of terms before coinciding points are merged and zeros dropped; exact for all but those.
  Index length(Vertex v) {
    if (!is_plain_[index(v)]) return static_cast<Index>(row(v).size());
    return smooth_weights(v).count();
  }
  Index length(Edge e) {
    const float s = sharpness_.edge[index(e)];
    if (has_crease_row(e)) return s >= 1 && !crease_is_wide_ ? 2 : static_cast<Index>(row(e).size());
    return smooth_weights(e).count();
  }
  Index length(Face f) {
    if (!wide_face_) return t_.size(f);  // with intervals at most
    const Weights& weights = wide_weights(f);
    if (weights.on_edges.empty()) return weights.count();
    add_with_edges(f, weights);
    sum_columns();
    return static_cast<Index>(row_.size());
  }
  Index length(HalfEdge corner) { return smooth_weights(corner).count(); }
  /// A point on a half-edge without twin, at the fraction `part` from its tail.
  struct Border {
    HalfEdge half;
    Index part, parts;
  };
  Index length(const Border& border) { return static_cast<Index>(row(border).size()); }

  /// Writes the row of the child of an element, columns ascending, zeros dropped; returns its length.
  template <class Element>
  Index write(Element element, Index* columns, T* values) {
    return by_rule(
        element, [&](const Weights& weights) { return write_smooth(element, weights, columns, values); },
        [&](const std::vector<Term>& row) { return write(row, columns, values); });
  }
  /// Calls term(column, weight) for the terms of a row: for smooth rows in the order of the site, with one term
  /// per slot even if points coincide. Sorts and stores nothing.
  template <class Element, class Visit>
  [[gnu::always_inline]] void visit(Element element, const Visit& term) {
    by_rule(
        element,
        [&](const Weights& weights) __attribute__((always_inline)) {
          const T* weight = weights.data();
          visit_element(
              element, weights, [&](Index v) __attribute__((always_inline)) {
                if (*weight != T(0)) term(v, *weight);
                ++weight;
              });
        },
        [&](const std::vector<Term>& row) {
          for (const auto& [column, weight] : row) term(column, weight);
        });
  }

 private:
  /// Calls smooth(weights) if the row comes from masks alone, else sharp(row).
  template <class Smooth, class Sharp>
  [[gnu::always_inline]] auto by_rule(Face f, const Smooth& smooth, const Sharp& sharp) {
    if (!wide_face_) return smooth(smooth_weights(f));
    const Weights& weights = wide_weights(f);
    return weights.on_edges.empty() ? smooth(weights) : sharp(row(f, weights));
  }
  template <class Smooth, class Sharp>
  [[gnu::always_inline]] auto by_rule(Edge e, const Smooth& smooth, const Sharp& sharp) {
    return has_crease_row(e) ? sharp(row(e)) : smooth(smooth_weights(e));
  }
  template <class Smooth, class Sharp>
  [[gnu::always_inline]] auto by_rule(Vertex v, const Smooth& smooth, const Sharp& sharp) {
    return is_plain_[index(v)] ? smooth(smooth_weights(v)) : sharp(row(v));
  }
  template <class Smooth, class Sharp>
  [[gnu::always_inline]] auto by_rule(HalfEdge corner, const Smooth& smooth, const Sharp&) {
    return smooth(smooth_weights(corner));
  }
  template <class Smooth, class Sharp>
  [[gnu::always_inline]] auto by_rule(const Border& border, const Smooth&, const Sharp& sharp) {
    return sharp(row(border));
  }

  std::vector<T> dense(const char* mask, const Stencil<T>& stencil, Index slots) const {
    check_weights(scheme_, mask, stencil, slots);
    std::vector<T> weights(slots, T(0));
    for (const auto& [slot, weight] : stencil.terms()) weights[slot] = weight;
    return weights;
  }

  bool has_crease_row(Edge e) const {
    if (wide_borders_ && !exists(t_.twin(t_.half_edge(e)))) return false;
    return is_sharp(sharpness_.edge[index(e)]);
  }

  /// Returns a row at sharp elements. Valid until the next call.
  const std::vector<Term>& row(Edge e) {
    row_.clear();
    add_crease_edge(e, T(1));
    return merge();
  }
  const std::vector<Term>& row(const Border& border) {
    row_.clear();
    const Vertex tail = t_.tail(border.half), head = t_.head(border.half);
    const bool near_tail = 2 * border.part < border.parts;
    add_curve(T(1), t_.edge(border.half), near_tail ? tail : head, near_tail ? head : tail);
    return merge();
  }
  const std::vector<Term>& row(Face f, const Weights& weights) {
    add_with_edges(f, weights);
    return merge();
  }
  /// Begins a row with a face's own points and those of the points on its edges.
  void add_with_edges(Face f, const Weights& weights) {
    row_.clear();
    add(f, T(1), weights);
    const Index size = t_.size(f);
    for (Index i = 0; i < size; ++i) {
      const HalfEdge h = t_.corner(f, i);
      if (weights.on_edges[i] != T(0)) add_edge(t_.edge(h), weights.on_edges[i]);
      if (weights.on_edges[size + i] != T(0))
        add_edge(t_.edge(t_.next(t_.next(t_.twin(h)))), weights.on_edges[size + i]);
    }
  }

  void add_edge(Edge e, const T& factor) {
    if (has_crease_row(e)) {
      add_crease_edge(e, factor);
    } else {
      add(e, factor, smooth_weights(e));
    }
  }
  void add_crease_edge(Edge e, const T& factor) {
    const float s = sharpness_.edge[index(e)];
    const T w = stays_sharp(e) ? T(1) : T(s);
    add_curve(factor * w, e, t_.tail(e), t_.head(e));
    if (w != T(1)) add(e, factor * (T(1) - w), smooth_weights(e));
  }
  /// Returns the mask of a sharp edge, in the direction from `tail`.
  void add_curve(const T& factor, Edge e, Vertex tail, Vertex head) {
    Index before = -1, after = -1;
    if (crease_is_wide_) {
      before = along_curve(e, tail);
      after = along_curve(e, head);
    }
    const std::vector<T>& weights =
        knots_ ? curve_ = dense("crease_edge",
                                creases_.edge(CreaseEdgeSite<T>(step_masks_, level_, before >= 0, after >= 0,
                                                                curve_knots(e, tail, head))),
                                4)
               : crease_edge_[before >= 0][after >= 0];
    const Index ends[] = {index(tail), index(head), before, after};
    for (int i = 0; i < 4; ++i)
      if (ends[i] >= 0 && weights[i] != T(0)) row_.push_back({ends[i], factor * weights[i]});
  }
  EdgeKnots<T> curve_knots(Edge e, Vertex from, Vertex to) const {
    return MaskTable<T>::cast(knots_->along(e, from, next_on_curve(e, from), next_on_curve(e, to)));
  }
  /// Returns the next edge of a crease beyond one of its ends; nothing if the curve ends there.
  std::optional<Edge> next_on_curve(Edge e, Vertex end) const {
    if (is_sharp(sharpness_.vertex[index(end)])) return std::nullopt;  // a corner, perhaps of very many edges
    Edge other = e;
    int count = 0;
    for (const Edge sharp : t_.edges(end)) {
      if (!is_sharp(sharpness_.edge[index(sharp)])) continue;
      if (++count > 2) return std::nullopt;
      if (sharp != e) other = sharp;
    }
    return count == 2 ? std::optional(other) : std::nullopt;
  }
  /// Returns the next vertex there, or -1.
  Index along_curve(Edge e, Vertex end) const {
    const std::optional<Edge> next = next_on_curve(e, end);
    return next ? other_end(*next, end) : -1;
  }

  const std::vector<Term>& row(Vertex v) {
    VertexSharpness around(t_, sharpness_, v);
    if (sharpness_.creasing == Creasing::chaikin) use_child_sharpness(v, around);
    const Rule rule = around.rule(), child_rule = around.child_rule();
    row_.clear();
    if (rule == child_rule) {
      add_rule(T(1), rule, v, around.edges);
    } else {
      const T w(around.parent_weight());
      add_rule(w, rule, v, around.edges);
      add_rule(T(1) - w, child_rule, v, around.child_edges);
    }
    return merge();
  }

  /// With Chaikin creasing the decay of an edge depends on edges around it. A face-varying channel lacks those
  /// beyond its seams, so the sharpness of the child edges is used instead.
  void use_child_sharpness(Vertex v, VertexSharpness& around) const {
    if (!is_primal(refinement_.split)) return;
    const std::vector<Edge> edges = t_.edges(v);
    for (size_t i = 0; i < edges.size(); ++i) {
      if (!is_semi_sharp(around.edges[i]) || t_.tail(edges[i]) == t_.head(edges[i])) continue;
      const auto [at_tail, at_head] = refinement_.halves(t_, t_.half_edge(edges[i]));
      const HalfEdge near = t_.tail(edges[i]) == v ? at_tail : at_head;
      around.child_edges[i] = child_sharpness_.edge[index(refinement_.topology.edge(near))];
    }
  }

  const Weights& smooth_weights(Vertex v) {
    if (knots_) {
      site_knots_.clear();
      HalfEdge h = t_.outgoing(v);
      do {
        site_knots_.push_back(knots_->of_face(h));
        h = t_.ccw(h);
      } while (h != t_.outgoing(v));
      if (!MaskTable<T>::are_equal(site_knots_)) return masks_.vertex(site_knots_);
    }
    if (t_.uniform_face_size()) return masks_.vertex(t_.num_faces(v), t_.uniform_face_size());
    face_sizes_around(t_, v, sizes_);
    return masks_.vertex(sizes_);
  }
  const Weights& smooth_weights(Edge e) {
    if (knots_) {
      const HalfEdge left = t_.half_edge(e);
      site_knots_ = {knots_->of_face(left), knots_->of_face(t_.twin(left))};
      if (!MaskTable<T>::are_equal(site_knots_)) return masks_.edge(site_knots_);
    }
    if (wide_edge_) {
      const auto [tail, head] = shapes(e);
      return masks_.wide_edge(t_.uniform_face_size(), tail, head);
    }
    if (t_.uniform_face_size()) return masks_.uniform_edge(t_.uniform_face_size());
    const HalfEdge h = t_.half_edge(e);
    return masks_.edge(t_.size(t_.face(h)), t_.size(t_.face(t_.twin(h))));
  }

  const Weights& smooth_weights(HalfEdge corner) {
    if (knots_) {
      site_knots_ = {knots_->of_face(corner)};
      if (!MaskTable<T>::are_equal(site_knots_, KnotOwner::point)) return masks_.corner(site_knots_);
    }
    return masks_.corner(t_.size(t_.face(corner)));
  }
  const Weights& smooth_weights(Face f) {
    if (knots_) {
      site_knots_ = {knots_->of_face(t_.first(f))};
      if (!MaskTable<T>::are_equal(site_knots_)) return masks_.face(site_knots_);
    }
    return masks_.face(t_.size(f));
  }

  bool is_cut(HalfEdge h) const { return !exists(t_.twin(h)) || is_sharp(sharpness_.edge[index(t_.edge(h))]); }
  FanShape shape(HalfEdge h) const {
    const Vertex v = t_.tail(h);
    if (is_plain_[index(v)]) return {t_.num_faces(v), -1};
    return fan_shape(t_, h, [&](HalfEdge g) { return is_cut(g); });
  }
  std::pair<FanShape, FanShape> shapes(Edge e) const {
    const HalfEdge left = t_.half_edge(e), right = t_.twin(left);
    if (exists(right)) return {shape(left), shape(right)};
    FanShape head = shape(t_.next(left));  // of a border edge: the last one of its head's fan
    ++head.start;
    return {shape(left), head};
  }
  const Weights& wide_weights(Face f) {
    shapes_.clear();
    for (Index i = 0; i < t_.size(f); ++i) shapes_.push_back(shape(t_.corner(f, i)));
    return masks_.wide_face(shapes_);
  }
  /// Returns the vertices of a site in the order of its slots.
  template <class Element, class Visit>
  [[gnu::always_inline]] void visit_narrow(Element element, const Visit& visit) const {
    if constexpr (std::is_same_v<T, double>) {  // of others, sums take longer than walks
      if (t_.uniform_face_size() == 4) return visit_site(quads_, element, visit);
      if (t_.uniform_face_size() == 3) return visit_site(triangles_, element, visit);
    }
    visit_site(t_, element, visit);
  }
  /// Returns the vertices of an element's site, in the order of its slots. For a face, call `wide_weights`
  /// before.
  template <class Visit>
  [[gnu::always_inline]] void visit_element(Edge e, const Weights& weights, const Visit& visit) const {
    if (!wide_edge_) return visit_narrow(e, visit);
    visit_wide_edge(t_, t_.half_edge(e), weights.tail, weights.head, visit);
  }
  template <class Visit>
  [[gnu::always_inline]] void visit_element(Face f, const Weights&, const Visit& visit) const {
    wide_face_ ? visit_wide_face(t_, f, shapes_, visit) : visit_narrow(f, visit);
  }
  template <class Visit>
  [[gnu::always_inline]] void visit_element(Vertex v, const Weights& weights, const Visit& visit) const {
    weights.size() == 1 ? visit(index(v)) : visit_narrow(v, visit);
  }
  template <class Visit>
  [[gnu::always_inline]] void visit_element(const Border&, const Weights&, const Visit&) const {
  }  // their rows are all sharp
  template <class Element, class Visit>
  [[gnu::always_inline]] void visit_element(Element element, const Weights&, const Visit& visit) const {
    visit_narrow(element, visit);
  }

  static Index write(const std::vector<Term>& row, Index* columns, T* values) {
    for (const auto& [c, w] : row) {
      *columns++ = c;
      *values++ = w;
    }
    return static_cast<Index>(row.size());
  }

  template <class Element>
  Index write_smooth(Element element, const Weights& weights, Index* columns, T* values) {
    gather(element, weights);
    const Index count = weights.count();
    Index written = 0;  // unless ranking serves
    if (count <= 4)
      written = write_ranked<4>(weights, columns, values);
    else if (count <= 8)
      written = write_ranked<8>(weights, columns, values);
    else if (count <= 12)
      written = write_ranked<12>(weights, columns, values);
    else if (count <= 16)
      written = write_ranked<16>(weights, columns, values);
    if (written) return written;
    row_.clear();
    add_gathered(T(1), weights);
    return write(merge(), columns, values);
  }

  /// Stores the vertices of an element whose weights are not zero in `gathered_`, with room for 16 more.
  template <class Element>
  void gather(Element element, const Weights& weights) {
    if (gathered_.size() < weights.size() + 16) gathered_.resize(weights.size() + 16);
    Index* slot = gathered_.data();
    visit_element(element, weights, [&](Index v) { *slot++ = v; });
    if (!weights.has_zeros) return;
    for (Index i = 0; i < weights.count(); ++i) gathered_[i] = gathered_[weights.kept[i]];
  }

  /// Writes a row of up to N gathered terms and returns its length; returns 0 if points coincide. The position
  /// of a column is the number of smaller ones: comparisons without branches, which avoids the mispredictions
  /// of sorting.
  template <Index N>
  Index write_ranked(const Weights& weights, Index* columns, T* values) {
    const Index count = weights.count();
    std::fill_n(gathered_.begin() + count, N - count, std::numeric_limits<Index>::max());
    Index slots[N], rank[N] = {};
    std::copy_n(gathered_.begin(), N, slots);
    for (Index j = 0; j < N; ++j)  // all N: unrolled, the ranks stay in registers
      for (Index i = 0; i < N; ++i) rank[i] += slots[j] < slots[i];
    const Index pairs = std::accumulate(rank, rank + N, 0) - (N - count) * count;
    if (pairs != count * (count - 1) / 2) return 0;  // some pair is equal
    for (Index i = 0; i < count; ++i) {
      columns[rank[i]] = slots[i];
      values[rank[i]] = weights.nonzero(i);
    }
    return count;
  }

  void add_rule(const T& w, Rule rule, Vertex v, const std::vector<float>& edges) {
    if (w == T(0)) return;
    if (rule == Rule::corner) {
      row_.push_back({index(v), w});
    } else if (rule == Rule::crease) {
      const std::vector<Edge> around = t_.edges(v);
      const auto [first, last] = crease_ends(edges);
      const Edge ends[] = {around[first], around[last]};
      const Index vertices[] = {index(v), other_end(ends[0], v), other_end(ends[1], v)};
      std::vector<T>& weights = knots_ ? curve_ : crease_vertex_;
      if (knots_) {
        const auto seen = [&](int k) {
          const std::optional<Edge> beyond = next_on_curve(ends[k], Vertex{vertices[k + 1]});
          return MaskTable<T>::cast(knots_->along(ends[k], v, ends[1 - k], beyond));
        };
        weights = dense("crease_vertex", creases_.vertex(CreaseSite<T>(step_masks_, level_, seen(0), seen(1))), 3);
      }
      for (int k = 0; k < 3; ++k) row_.push_back({vertices[k], w * weights[k]});
    } else {
      add(v, w, smooth_weights(v));
    }
  }

  /// Merges equal columns of the row at their first position, summing terms in order, by a table of columns.
  /// Much faster than sorting many equal columns.
  void sum_columns() {
    size_t size = 64;
    while (size < 2 * row_.size()) size *= 2;
    place_of_.assign(size, -1);
    size_t kept = 0;
    for (size_t i = 0; i < row_.size(); ++i) {
      size_t at = (static_cast<std::uint32_t>(row_[i].first) * 2654435761u >> 7) & (size - 1);
      while (place_of_[at] >= 0 && row_[place_of_[at]].first != row_[i].first) at = (at + 1) & (size - 1);
      if (place_of_[at] >= 0) {
        row_[place_of_[at]].second += row_[i].second;
        continue;
      }
      place_of_[at] = static_cast<Index>(kept);
      if (kept != i) row_[kept] = std::move(row_[i]);
      ++kept;
    }
    row_.resize(kept);
  }

  Index other_end(Edge e, Vertex v) const { return index(t_.tail(e) == v ? t_.head(e) : t_.tail(e)); }

  /// True if an edge is a full crease: its sharpness is 1 or more or, with Chaikin creasing, both its halves
  /// stay sharp.
  bool stays_sharp(Edge e) const {
    if (sharpness_.edge[index(e)] >= 1) return true;
    if (sharpness_.creasing == Creasing::uniform) return false;
    const auto [first, second] = refinement_.halves(t_, t_.half_edge(e));
    const auto sharp = [&](HalfEdge h) { return is_sharp(child_sharpness_.edge[index(refinement_.topology.edge(h))]); };
    return sharp(first) && sharp(second);
  }

  template <class Element>
  void add(Element element, const T& factor, const Weights& weights) {
    gather(element, weights);
    add_gathered(factor, weights);
  }
  void add_gathered(const T& factor, const Weights& weights) {
    for (Index i = 0; i < weights.count(); ++i) row_.push_back({gathered_[i], factor * weights.nonzero(i)});
  }
  const std::vector<Term>& merge() {
    const auto less = [](const Term& a, const Term& b) { return a.first < b.first; };
    if (row_.size() <= 24) {  // insertion sort: stable, and the fastest for the short rows that are nearly all
      for (size_t i = 1; i < row_.size(); ++i) {
        Term term = std::move(row_[i]);
        size_t j = i;
        for (; j > 0 && less(term, row_[j - 1]); --j) row_[j] = std::move(row_[j - 1]);
        row_[j] = std::move(term);
      }
    } else {  // most points come several times
      sum_columns();
      std::sort(row_.begin(), row_.end(), less);
    }
    const auto odd = [&](size_t i) {  // coincides with the one before, or is nothing
      return row_[i].second == T(0) || (i > 0 && row_[i].first == row_[i - 1].first);
    };
    size_t kept = 0;
    while (kept < row_.size() && !odd(kept)) ++kept;
    if (kept == row_.size()) return row_;
    for (size_t i = kept; i < row_.size(); ++i) {
      if (kept > 0 && row_[kept - 1].first == row_[i].first) {
        row_[kept - 1].second += row_[i].second;
      } else {
        if (kept > 0 && row_[kept - 1].second == T(0)) --kept;
        if (kept != i) row_[kept] = std::move(row_[i]);
        ++kept;
      }
    }
    if (kept > 0 && row_[kept - 1].second == T(0)) --kept;
    row_.resize(kept);
    return row_;
  }

  const Topology& t_;
  UniformFaces<4> quads_;  // the same, where it has nothing else
  UniformFaces<3> triangles_;
  const Refinement& refinement_;
  const Sharpness& sharpness_;
  const Sharpness& child_sharpness_;
  const std::vector<std::uint8_t>& is_plain_;
  const std::string& scheme_;  // its name
  MaskTable<T> masks_;
  const CreaseMasks<T>& creases_;
  const Masks<T>& step_masks_;
  int level_;
  std::optional<LevelKnots> knots_;  // where intervals differ
  typename MaskTable<T>::Knots site_knots_;
  std::vector<T> crease_vertex_, crease_edge_[2][2], curve_;
  bool crease_is_wide_ = false, wide_edge_ = false, wide_face_ = false, wide_borders_ = false;
  std::vector<Index> sizes_, gathered_, place_of_;
  std::vector<FanShape> shapes_;
  std::vector<Term> row_;
};

/// Calls body with the parent element that a child comes from.
template <class T, class Body>
auto with_parent(const Refinement& refinement, Vertex child, const Body& body) {
  const Index parent = refinement.parent(child);
  switch (refinement.origin(child)) {
    case Refinement::Origin::vertex:
      return body(Vertex{parent});
    case Refinement::Origin::face:
      return body(Face{parent});
    case Refinement::Origin::edge:
      return body(Edge{parent});
    case Refinement::Origin::corner:
      return body(HalfEdge{parent});
    default:
      return body(typename RowMaker<T>::Border{HalfEdge{parent}, refinement.part(child), refinement.border_points});
  }
}

/// Writes the row of a child; returns its length.
template <class T>
Index write_row(RowMaker<T>& maker, const Refinement& refinement, Vertex child, Index* columns, T* values) {
  return with_parent<T>(refinement, child, [&](auto element) { return maker.write(element, columns, values); });
}

/// Returns per vertex whether it is an interior manifold vertex, and neither it nor an edge at it is sharp.
inline std::vector<std::uint8_t> plain_vertices(const Topology& t, const Sharpness& sharpness) {
  std::vector<std::uint8_t> plain(t.num_vertices());
  parallel_for(t.num_vertices(), [&](std::int64_t i) {
    const Vertex v{static_cast<Index>(i)};
    plain[i] = !is_sharp(sharpness.vertex[i]) && exists(t.outgoing(v)) && exists(t.twin(t.outgoing(v)));
  });
  for (Index e = 0; e < t.num_edges(); ++e)
    if (is_sharp(sharpness.edge[e])) plain[index(t.tail(Edge{e}))] = plain[index(t.head(Edge{e}))] = 0;
  return plain;
}

/// Closes gaps between blocks of rows, if some rows are shorter than planned (coinciding points on small
/// meshes, weights of zero): the nonzeros of a block end at end[block], not where the next block starts.
template <class T>
SparseMatrixOf<T> compacted(const SparseMatrixOf<T>& loose, const std::vector<std::int64_t>& start,
                            const std::vector<std::int64_t>& end) {
  std::vector<std::int64_t> tight_start(start.size(), 0);
  for (size_t b = 0; b < end.size(); ++b) tight_start[b + 1] = tight_start[b] + end[b] - start[b];
  SparseMatrixOf<T> tight(loose.rows(), loose.cols());
  resize_nonzeros(tight, tight_start.back());
  tight.outerIndexPtr()[loose.rows()] = static_cast<Index>(tight_start.back());
  parallel_for_blocks(loose.rows(), [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    const std::int64_t from = start[block], to = tight_start[block], count = end[block] - from;
    for (std::int64_t r = first; r < last; ++r)
      tight.outerIndexPtr()[r] = loose.outerIndexPtr()[r] - static_cast<Index>(from - to);
    std::copy_n(loose.innerIndexPtr() + from, count, tight.innerIndexPtr() + to);
    std::copy_n(loose.valuePtr() + from, count, tight.valuePtr() + to);
  });
  return tight;
}

/// Fills a matrix so small that rows of the largest possible width fit into a buffer, in one pass, without
/// planning lengths. Saves blending rows twice on levels of single pieces of a limit, where most rows are
/// blended.
template <class T, class Maker, class Write>
SparseMatrixOf<T> assemble_small(Index rows, Index columns, Maker maker, const Write& write) {
  std::vector<Index> all_columns(size_t(rows) * columns);
  std::vector<T> all_values(all_columns.size());
  SparseMatrixOf<T> S(rows, columns);
  Index* const outer = S.outerIndexPtr();
  Index at = 0;
  for (Index r = 0; r < rows; ++r) {
    outer[r] = at;
    at += write(maker, r, all_columns.data() + at, all_values.data() + at);
  }
  outer[rows] = at;
  resize_nonzeros(S, at);
  std::copy_n(all_columns.begin(), at, S.innerIndexPtr());
  std::copy_n(all_values.begin(), at, S.valuePtr());
  return S;
}

/// Fills a matrix row by row: length_of(maker, r) returns an upper bound of the length, and write(maker, r,
/// columns, values) writes at most as many terms.
template <class T, class MakeMaker, class LengthOf, class Write>
SparseMatrixOf<T> assemble(Index rows, Index columns, const MakeMaker& make_maker, const LengthOf& length_of,
                           const Write& write) {
  if constexpr (std::is_trivially_copyable_v<T>) {  // a buffer of others costs more than a plan
    constexpr std::int64_t small = 1 << 14;         // entries if there were no zeros
    if (std::int64_t{rows} * columns <= small) return assemble_small<T>(rows, columns, make_maker(), write);
  }
  tbb::enumerable_thread_specific<std::invoke_result_t<const MakeMaker&>> makers(make_maker);
  std::vector<std::int64_t> start(num_blocks(rows) + 1, 0);
  parallel_for_blocks(rows, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    auto& maker = makers.local();
    std::int64_t sum = 0;
    for (std::int64_t r = begin; r < end; ++r) sum += length_of(maker, static_cast<Index>(r));
    start[block + 1] = sum;
  });
  std::partial_sum(start.begin(), start.end(), start.begin());
  if (start.back() > std::numeric_limits<Index>::max())
    throw ResourceError("the matrix would have " + std::to_string(start.back()) +
                        " nonzeros, more than 32-bit indices count; use fewer levels or refine fewer faces");

  SparseMatrixOf<T> S(rows, columns);
  resize_nonzeros(S, start.back());
  Index* const outer = S.outerIndexPtr();
  outer[rows] = static_cast<Index>(start.back());
  std::vector<std::int64_t> block_end(start.size() - 1);
  parallel_for_blocks(rows, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    auto& maker = makers.local();
    Index at = static_cast<Index>(start[block]);
    for (std::int64_t r = begin; r < end; ++r) {
      outer[r] = at;
      at += write(maker, static_cast<Index>(r), S.innerIndexPtr() + at, S.valuePtr() + at);
    }
    block_end[block] = at;
  });
  if (!std::equal(block_end.begin(), block_end.end(), start.begin() + 1)) compacted(S, start, block_end).swap(S);
  return S;
}

}  // namespace assembly

template <class T>
SparseMatrixOf<T> subdivision_matrix(const Scheme<T>& scheme, const Step<T>& step, const Topology& parent,
                                     const Refinement& refinement, const Sharpness& sharpness,
                                     const Sharpness& child_sharpness, int level, const KnotSplit* knots) {
  const std::vector<std::uint8_t> plain = assembly::plain_vertices(parent, sharpness);
  using Maker = assembly::RowMaker<T>;
  return assembly::assemble<T>(
      refinement.topology.num_vertices(), parent.num_vertices(),
      [&] { return Maker(scheme, step, parent, refinement, sharpness, child_sharpness, level, knots, plain); },
      [&](Maker& maker, Index r) {
        return assembly::with_parent<T>(refinement, Vertex{r}, [&](auto element) { return maker.length(element); });
      },
      [&](Maker& maker, Index r, Index* columns, T* values) {
        return assembly::write_row(maker, refinement, Vertex{r}, columns, values);
      });
}

}  // namespace sublimit
