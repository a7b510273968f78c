// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/stationary_rows.h"

#include <algorithm>
#include <map>

#include "sublimit/core/sparse_product.h"
#include "sublimit/limit/tangents.h"
#include "sublimit/neighborhood/closed_set.h"
#include "sublimit/neighborhood/local_patch.h"
#include "sublimit/neighborhood/walk.h"

namespace sublimit {
namespace {

/// What is around a centre: the walk, then the points of curves that leave it, in order.
struct Neighborhood {
  Walk walk;
  std::vector<Index> point;     ///< number of the point of each slot: points of several fans coincide
  std::vector<Index> vertices;  ///< by number
  Index num_inner = 0;          ///< those that have been looked around, the first ones
  std::vector<Index> curves;    ///< and those of curves whose next point is there

  Neighborhood(const Level& level, const Centre& centre, int depth)
      : walk(sublimit::walk(level.topology(), level.sharpness, centre, depth)) {
    std::map<Index, Index> number;
    const auto add = [&](Index v) {
      const auto [at, is_new] = number.try_emplace(v, static_cast<Index>(vertices.size()));
      if (is_new) vertices.push_back(v);
      return at->second;
    };
    for (size_t s = 0; s < walk.vertices.size(); ++s) {
      point.push_back(add(walk.vertices[s]));
      if (s + 1 == size_t(walk.ring_end[depth - 1])) num_inner = static_cast<Index>(vertices.size());
    }
    // A side that begins and ends with one of the two edges of a curve does not see the other one, which its vertex has its
    // rule from. Beyond it each point of the curve has one that is not known.
    std::vector<Index> ends;
    for (Index i = 0; i < num_inner; ++i)
      if (const Index next = beyond(level, Vertex{vertices[i]}, number); next >= 0) ends.push_back(add(next));
    for (Index i : ends)
      for (int k = 1; k < depth; ++k) {
        const Index next = beyond(level, Vertex{vertices[i]}, number);
        if (next < 0) break;
        curves.push_back(i);
        i = add(next);
      }
  }
  bool operator==(const Neighborhood& other) const {
    return walk.signature == other.walk.signature && point == other.point && vertices.size() == other.vertices.size() &&
           curves == other.curves;
  }

 private:
  /// The next vertex of a non-manifold curve that is not known, -1 where there is none.
  static Index beyond(const Level& level, Vertex v, const std::map<Index, Index>& number) {
    const Topology& t = level.topology();
    if (!t.is_nonmanifold(v)) return -1;
    const VertexSharpness around(t, level.sharpness, v);
    if (around.rule() != Rule::crease) return -1;
    const std::vector<Edge> edges = t.edges(v);
    const auto [first, last] = crease_ends(around.edges);
    for (const auto end : {first, last}) {
      const Edge e = edges[size_t(end)];
      const Index head = index(t.tail(e) == v ? t.head(e) : t.tail(e));
      if (!number.contains(head)) return head;
    }
    return -1;
  }
};

}  // namespace

std::optional<LimitRows> stationary_rows(const Level& whole, const Scheme<double>& scheme, const Centre& from) {
  const int margin = rings_of_masks(scheme), deep = 1 + margin;
  Level level;
  level.number = whole.number;
  const Index face = index(whole.topology().face(from.start));
  const Part around = part(whole, std::span(&face, 1), deep + scheme.period * (margin + 2));
  const auto at = std::lower_bound(around.halves.begin(), around.halves.end(), index(from.start));
  Centre centre{from.kind, HalfEdge{static_cast<Index>(at - around.halves.begin())}};
  const Neighborhood before(around.level, centre, deep);
  SparseMatrix S;
  for (int k = 0; k < scheme.period; ++k) {
    const Level& parent = k == 0 ? around.level : level;
    Level next = next_level(scheme, parent);
    const Topology* t = &parent.topology();
    for (const Refinement& step : next.steps) {
      centre = child(centre, *t, step, parent.number);
      t = &step.topology;
    }
    k == 0 ? S.swap(next.S) : product(next.S, S).swap(S);
    level = std::move(next);
  }
  const Neighborhood after(level, centre, deep);
  if (!(after == before)) return std::nullopt;

  // A over the points that those of the centre depend on. Of those last met the neighbours are not known.
  const auto count = static_cast<Index>(before.vertices.size());
  std::vector<Index> point_of(S.cols(), -1);
  for (Index i = 0; i < count; ++i) point_of[before.vertices[i]] = i;
  std::vector<bool> is_inner(count, false);
  std::fill_n(is_inner.begin(), before.num_inner, true);
  for (const Index i : before.curves) is_inner[i] = true;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(count, count);
  const std::vector<Index> own(before.point.begin(), before.point.begin() + before.walk.ring_end[0]);
  bool is_closed = true;
  closed_set(own, count, [&](Index i, const auto& add) {
    for (SparseMatrix::InnerIterator it(S, after.vertices[i]); is_closed && it; ++it) {
      const Index j = point_of[it.col()];
      is_closed = j >= 0 && is_inner[j];
      if (!is_closed) return;
      A(i, j) += it.value();
      add(j);
    }
  });
  if (!is_closed) return std::nullopt;
  LimitRows rows;
  const Eigen::VectorXd mask = position_mask(A, own, std::nullopt);
  for (Index i = 0; i < count; ++i)
    if (mask[i] != 0) rows.position.push_back({around.vertices[before.vertices[i]], mask[i]});
  std::sort(rows.position.begin(), rows.position.end());
  rows.plane = LimitMasks::Plane::no;
  const LocalType type = local_type(whole.topology(), whole.sharpness, from, whole.number, scheme.period);
  rows.rule = type.corner ? Rule::corner : type.open || type.kind == Centre::Kind::border ? Rule::crease : Rule::smooth;
  rows.faces = type.faces;
  return rows;
}

}  // namespace sublimit
