// SPDX-License-Identifier: Apache-2.0
#include "sublimit/splits/child_intervals.h"

namespace sublimit {

KnotIntervals child_intervals(const Topology& parent, const Refinement& refinement, const KnotIntervals& intervals,
                              const KnotSplit& split) {
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
    return Half{first ? split.at_tail[e] : intervals.length[e] - split.at_tail[e], ends >> (first ? 0 : 1) & 1,
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
