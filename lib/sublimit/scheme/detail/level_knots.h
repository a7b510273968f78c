// SPDX-License-Identifier: Apache-2.0
#pragma once
// Knots of sites, from the intervals and the new knots of a level's edges.
#include <optional>
#include <vector>

#include "sublimit/mesh/knot_intervals.h"
#include "sublimit/scheme/sites.h"

namespace sublimit {

class LevelKnots {
 public:
  /// @param topology, split  must outlive this
  LevelKnots(const Topology& topology, const KnotSplit& split) : t_(topology), split_(split) {}
  LevelKnots(const Topology&&, const KnotSplit&) = delete;
  LevelKnots(const Topology&, const KnotSplit&&) = delete;

  /// Returns the knots of the edge of a half-edge, seen from its tail.
  EdgeKnots<double> at(HalfEdge h) const {
    if (split_.owner == KnotOwner::point) return of_points(knot_entry(split_.owner, t_, h));
    return {length(h), split(h), beyond(h, true).value_or(length(h)), beyond(h, false).value_or(length(h))};
  }
  /// Returns the knots of all edges of its face, from this half-edge on.
  std::vector<EdgeKnots<double>> of_face(HalfEdge h) const {
    std::vector<EdgeKnots<double>> result;
    HalfEdge k = h;
    do {
      result.push_back(at(k));
      k = t_.next(k);
    } while (k != h);
    return result;
  }
  /// Returns the knots of an edge of a curve, seen from one of its ends. Beyond an end of the curve its last interval
  /// is mirrored.
  /// @param before, after  the curve's edges beyond this end and beyond the other
  EdgeKnots<double> along(Edge e, Vertex from, std::optional<Edge> before, std::optional<Edge> after) const {
    if (split_.owner == KnotOwner::point) return of_points(knot_entry(split_.owner, e, t_.tail(e) == from));
    const double d = split_.length[index(e)], s = split_.distance[index(e)];
    const auto own = [&](const std::optional<Edge>& other) { return other ? split_.length[index(*other)] : d; };
    return {d, t_.tail(e) == from ? s : d - s, own(before), own(after)};
  }

 private:
  EdgeKnots<double> of_points(size_t near) const {
    const size_t far = other_end(near);
    return {split_.length[near], split_.distance[near], split_.distance[far], split_.length[far]};
  }
  double length(HalfEdge h) const { return split_.length[index(t_.edge(h))]; }
  double split(HalfEdge h) const {
    const double s = split_.distance[index(t_.edge(h))];
    return t_.forward(h) ? s : length(h) - s;
  }
  /// Returns the mean interval of the second edges after h around an end of it, on either side; nothing if
  /// faces end before.
  std::optional<double> beyond(HalfEdge h, bool at_tail) const {
    const HalfEdge twin = t_.twin(h);
    // Half-edges that leave that end: counter-clockwise from the edge's own one, clockwise from the one beside it.
    const HalfEdge out = at_tail ? h : twin, into = at_tail ? twin : h;
    double sum = 0;
    int count = 0;
    const auto add = [&](HalfEdge k) {
      sum += length(k);
      ++count;
    };
    if (exists(out))
      if (const HalfEdge g = t_.ccw(out); exists(g)) add(t_.prev(g));
    if (exists(into))
      if (const HalfEdge g = t_.twin(t_.next(into)); exists(g)) add(t_.next(g));
    if (count == 0) return std::nullopt;
    return sum / count;
  }

  const Topology& t_;
  const KnotSplit& split_;
};

}  // namespace sublimit
