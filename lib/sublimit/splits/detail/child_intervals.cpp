// SPDX-License-Identifier: Apache-2.0
#include "sublimit/splits/detail/child_intervals.h"

namespace sublimit {

namespace {

/// Degree 2, dqq: along its own face's edges a child keeps the part of its parent's interval that is next to the edge.
KnotIntervals child_point_intervals(const Topology& parent, const Refinement& refinement,
                                    const KnotIntervals& intervals, const KnotSplit& split) {
  KnotIntervals result{.owner = KnotOwner::point, .length = {}, .ends = {}, .least = intervals.least / 2};
  if (intervals.empty()) return result;
  const Topology& t = refinement.topology;
  result.length.assign(2 * size_t(t.num_edges()), 0);
  const auto entry = [&](HalfEdge h) { return knot_entry(KnotOwner::point, t, h); };
  const auto at_tail = [&](HalfEdge h) -> double& { return result.length[entry(h)]; };
  const auto at_head = [&](HalfEdge h) -> double& { return result.length[other_end(entry(h))]; };
  for (Index i = 0; i < parent.num_half_edges(); ++i) {
    const HalfEdge h{i};
    const size_t to_next = knot_entry(KnotOwner::point, parent, h),
                 to_previous = other_end(knot_entry(KnotOwner::point, parent, parent.prev(h)));
    const double along = split.distance[to_next], across = split.distance[to_previous];
    // Around the child: along the face's two edges, and opposite to those, across the edges.
    const HalfEdge first{i}, second = t.twin(t.prev(first)), across_edge = t.next(t.twin(first));
    at_tail(first) = at_head(t.prev(second)) = along;
    at_tail(second) = at_tail(across_edge) = across;
    if (exists(parent.twin(h))) continue;
    // Points on a border keep along it what their neighbours inside have, and the rest of what it cuts.
    const size_t next_back = other_end(to_next), next_on = knot_entry(KnotOwner::point, parent, parent.next(h));
    const HalfEdge border = t.next(across_edge), inwards = t.next(border);
    at_head(across_edge) = split.length[to_previous] - across;
    at_tail(inwards) = split.length[next_on] - split.distance[next_on];
    at_tail(border) = along;
    at_head(border) = split.distance[next_back];
    if (const HalfEdge out = t.twin(across_edge); exists(out)) at_head(t.prev(out)) = along;
    if (const HalfEdge out = t.twin(inwards); exists(out)) at_tail(t.next(out)) = split.distance[next_back];
  }
  if (!intervals.ends.empty()) set_point_ends(t, result);
  simplify(result);
  return result;
}

}  // namespace

KnotIntervals child_intervals(const Topology& parent, const Refinement& refinement, const KnotIntervals& intervals,
                              const KnotSplit& split) {
  if (intervals.owner == KnotOwner::point) return child_point_intervals(parent, refinement, intervals, split);
  KnotIntervals result{.length = {}, .ends = {}, .least = intervals.least / 2, .plain = false};
  if (intervals.empty()) return result;
  const Topology& t = refinement.topology;
  const bool has_ends = !intervals.ends.empty();
  result.length.resize(t.num_edges());
  if (has_ends) result.ends.resize(t.num_edges());
  struct Half {
    double length;
    unsigned outer, inner;  // extraordinary vertices on the rail of the parent's vertex, on the new one
  };
  const auto half = [&](HalfEdge h, bool at_tail) {
    const Index e = index(parent.edge(h));
    const bool first = parent.forward(h) == at_tail;  // the half at the edge's own tail
    const unsigned ends = has_ends ? intervals.ends[e] : 0;
    return Half{first ? split.distance[e] : intervals.length[e] - split.distance[e], ends >> (first ? 0 : 1) & 1,
                ends >> (first ? 2 : 3) & 1};
  };
  // `child` runs from the rail of the parent's vertex to the new one, or back.
  const auto put = [&](HalfEdge child, const Half& own, bool inwards) {
    const Index e = index(t.edge(child));
    result.length[e] = own.length;
    if (!has_ends) return;
    const bool outer_first = t.forward(child) == inwards;
    result.ends[e] = static_cast<std::uint8_t>(outer_first ? own.outer | own.inner << 1 : own.inner | own.outer << 1);
  };
  for (Index i = 0; i < parent.num_half_edges(); ++i) {
    const HalfEdge h{i};
    const auto [first, second] = refinement.halves(parent, h);
    put(first, half(h, true), true);
    put(second, half(h, false), false);
    put(t.next(first), half(parent.next(h), true), true);  // from the edge's point to the face's
  }
  simplify(result);
  return result;
}

}  // namespace sublimit
