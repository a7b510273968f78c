// SPDX-License-Identifier: Apache-2.0
#include "sublimit/mesh/knot_intervals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/sharpness.h"

namespace sublimit {
namespace {

std::string edge_name(Index a, Index b) {
  const auto [low, high] = std::minmax(a, b);
  return "(" + std::to_string(low) + "," + std::to_string(high) + ")";
}
std::string edge_name(const Topology& t, Index e) { return edge_name(index(t.tail(Edge{e})), index(t.head(Edge{e}))); }

/// Intervals as given, 0 where none is.
std::vector<double> given_lengths(const Topology& t, const Mesh& mesh, KnotOwner owner) {
  const bool of_points = owner == KnotOwner::point;
  std::vector<double> length(size_t(t.num_edges()) * (of_points ? 2 : 1), 0);
  for (const Mesh::KnotInterval& given : mesh.knot_intervals) {
    const auto fail = [&](const std::string& why) {
      throw InvalidMesh("knot interval of edge " + edge_name(given.tail, given.head) + ": " + why);
    };
    for (const Index v : {given.tail, given.head})
      if (v < 0 || v >= t.num_vertices())
        fail("vertex " + std::to_string(v) + " does not exist; the mesh has " + std::to_string(t.num_vertices()));
    const Edge e = find_edge(t, Vertex{given.tail}, Vertex{given.head});
    if (index(e) < 0) fail("no face has this edge");
    if (!std::isfinite(given.length) || given.length < 0)
      fail("it is " + format_number(given.length) + "; it must be a positive number");
    if (given.length == 0 && of_points) fail("it is 0; double knots are not refined: it must be a positive number");
    if (given.length == 0)
      fail("it is 0; strips of interval 0 are not refined: merge their two sides, and for a sharp line there tag its " +
           std::string("edges as creases, as in 't crease 2/1/0 ") + std::to_string(given.tail) + " " +
           std::to_string(given.head) + " 10'");
    double& own = length[knot_entry(owner, e, index(t.tail(e)) == given.tail)];
    if (own != 0 && own != given.length)
      fail("given twice, as " + format_number(own) + " and as " + format_number(given.length));
    own = given.length;
  }
  return length;
}

/// Gives every edge of a strip the interval that one of them has.
void fill_strips(const Topology& t, std::vector<double>& length) {
  std::vector<Index> open;
  for (Index e = 0; e < t.num_edges(); ++e)
    if (length[e] != 0) open.push_back(e);
  for (size_t i = 0; i < open.size(); ++i)
    for (const HalfEdge h : t.half_edges(Edge{open[i]})) {
      const Face f = t.face(h);
      if (t.size(f) != 4) continue;
      const Index across = index(t.edge(t.next(t.next(h))));
      if (length[across] == length[open[i]]) continue;
      if (length[across] != 0)
        throw InvalidMesh("face " + std::to_string(index(f)) + ": its edge " + edge_name(t, open[i]) +
                          " has knot interval " + format_number(length[open[i]]) + ", the opposite edge " +
                          edge_name(t, across) + " has " + format_number(length[across]) +
                          "; opposite edges of a quadrilateral have one interval");
      length[across] = length[open[i]];
      open.push_back(across);
    }
  for (double& own : length)
    if (own == 0) own = 1;
}

/// Of each vertex of four edges, the two pairs of opposite ones, of a regular border vertex its two border edges, as
/// entries at that vertex.
template <class Pair>
void visit_opposites(const Topology& t, const Pair& pair) {
  for (Index i = 0; i < t.num_vertices(); ++i) {
    const Vertex v{i};
    if (t.is_isolated(v) || t.is_nonmanifold(v)) continue;
    const auto entry = [&](HalfEdge h) { return knot_entry(KnotOwner::point, t, h); };
    const HalfEdge first = t.outgoing(v);
    if (exists(t.twin(first))) {
      if (t.num_faces(v) != 4) continue;
      HalfEdge h[4] = {first};
      for (int k = 1; k < 4; ++k) h[k] = t.ccw(h[k - 1]);
      pair(v, entry(h[0]), entry(h[2]));
      pair(v, entry(h[1]), entry(h[3]));
    } else if (t.num_faces(v) == 2) {
      pair(v, entry(first), other_end(entry(t.prev(t.ccw(first)))));
    }
  }
}

/// Gives opposite ends at a vertex the interval that one of them has.
void fill_opposites(const Topology& t, std::vector<double>& length) {
  const auto far_vertex = [&](size_t entry) {
    const Edge e{static_cast<Index>(entry / 2)};
    return std::to_string(index(entry % 2 == 0 ? t.head(e) : t.tail(e)));
  };
  visit_opposites(t, [&](Vertex v, size_t a, size_t b) {
    if (length[a] == 0) length[a] = length[b];
    if (length[b] == 0) length[b] = length[a];
    if (length[a] != length[b])
      throw InvalidMesh("vertex " + std::to_string(index(v)) + ": its knot interval is " + format_number(length[a]) +
                        " towards vertex " + far_vertex(a) + ", and " + format_number(length[b]) +
                        " towards the opposite vertex " + far_vertex(b) +
                        "; opposite edges at a vertex have one interval of it");
  });
  for (double& own : length)
    if (own == 0) own = 1;
}

void check_polygons(const Topology& t, const std::vector<double>& length) {
  if (t.uniform_face_size() == 4) return;
  for (Index i = 0; i < t.num_faces(); ++i) {
    const Face f{i};
    if (t.size(f) == 4) continue;
    const Index first = index(t.edge(t.first(f)));
    for (Index k = 1; k < t.size(f); ++k) {
      const Index e = index(t.edge(t.corner(f, k)));
      if (length[e] != length[first])
        throw InvalidMesh("face " + std::to_string(i) + " has " + std::to_string(t.size(f)) +
                          " corners, and its edge " + edge_name(t, first) + " has knot interval " +
                          format_number(length[first]) + ", its edge " + edge_name(t, e) + " " +
                          format_number(length[e]) + "; a polygon other than a quadrilateral has one interval");
    }
  }
}

/// Where the limit is no tensor product, whatever the intervals.
/// @param corners  whether the only face at a border vertex makes it one: where borders are rounded
bool is_extraordinary(const Topology& t, Vertex v, bool corners = false) {
  if (t.is_isolated(v)) return false;
  if (t.is_nonmanifold(v)) return true;
  const bool boundary = !exists(t.twin(t.outgoing(v)));
  return boundary ? t.num_faces(v) > 2 || (corners && t.num_faces(v) == 1) : t.num_faces(v) != 4;
}

/// Fills `ends` and `least`.
void find_ends(const Topology& t, KnotIntervals& intervals) {
  const Index count = t.num_edges();
  // One node for each half of an edge, 2 e at its tail. The halves at a rail belong together: those of the edges before
  // and after an edge, at its ends. So do, across a polygon, the halves that its own first step makes neighbours.
  std::vector<Index> root(2 * size_t(count));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](Index i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  const auto half = [&](HalfEdge h, bool at_tail) { return 2 * index(t.edge(h)) + (t.forward(h) == at_tail ? 0 : 1); };
  for (Index i = 0; i < t.num_half_edges(); ++i) {
    const HalfEdge h{i};
    root[find(half(t.next(h), true))] = find(half(t.prev(h), false));
  }
  std::vector<std::uint8_t> outer(root.size(), 0), inner(root.size(), 0);
  double least = INFINITY;
  for (Index e = 0; e < count; ++e)
    for (const int end : {0, 1}) {
      const Vertex v = end == 0 ? t.tail(Edge{e}) : t.head(Edge{e});
      if (!is_extraordinary(t, v)) continue;
      outer[find(2 * e + end)] = 1;
      least = std::min(least, intervals.length[e]);
    }
  for (Index i = 0; i < t.num_faces(); ++i)
    if (const Face f{i}; t.size(f) != 4) {
      intervals.plain = true;
      for (Index k = 0; k < t.size(f); ++k) {
        const Index e = index(t.edge(t.corner(f, k)));
        inner[find(2 * e)] = inner[find(2 * e + 1)] = 1;
        least = std::min(least, intervals.length[e]);
      }
    }
  intervals.least = std::isfinite(least) ? least : 0;
  intervals.ends.resize(count);
  for (Index e = 0; e < count; ++e) {
    const Index tail = find(2 * e), head = find(2 * e + 1);
    intervals.ends[e] = static_cast<std::uint8_t>(outer[tail] | outer[head] << 1 | inner[tail] << 2 | inner[head] << 3);
  }
}

/// Whether levelling moves the new knot of an entry from the middle.
bool is_levelled(const KnotIntervals& intervals, size_t e) {
  if (intervals.plain || intervals.ends.empty()) return false;
  const unsigned ends = intervals.ends[e] & 3u;
  return (ends == 1 || ends == 2) && intervals.length[e] != intervals.least;
}

}  // namespace

void set_point_ends(const Topology& t, KnotIntervals& intervals) {
  constexpr std::uint8_t own = 1, beyond = 2;
  intervals.ends.assign(intervals.length.size(), 0);
  const auto flag = [&](HalfEdge h, bool both) {
    const size_t entry = knot_entry(KnotOwner::point, t, h);
    intervals.ends[entry] |= own;
    if (both) intervals.ends[other_end(entry)] |= own;
  };
  for (Index i = 0; i < t.num_half_edges(); ++i) {
    const HalfEdge h{i};
    if (t.size(t.face(h)) != 4) flag(h, true);
    if (is_extraordinary(t, t.tail(h), true)) flag(h, false);
    // The same at its head, as a border's last half-edge has no twin to say it.
    if (is_extraordinary(t, t.head(h), true)) intervals.ends[other_end(knot_entry(KnotOwner::point, t, h))] |= own;
  }
  visit_opposites(t, [&](Vertex, size_t a, size_t b) {
    if (intervals.ends[a] & own) intervals.ends[b] |= beyond;
    if (intervals.ends[b] & own) intervals.ends[a] |= beyond;
  });
}

KnotIntervals initial_intervals(const Topology& t, const Mesh& mesh, NewKnots rule, KnotOwner owner) {
  KnotIntervals result;
  result.owner = owner;
  if (mesh.knot_intervals.empty() || rule == NewKnots::none) return result;
  result.length = given_lengths(t, mesh, owner);
  if (owner == KnotOwner::point) {
    fill_opposites(t, result.length);
    if (rule == NewKnots::levelling) {
      set_point_ends(t, result);
      double least = INFINITY;
      for (size_t i = 0; i < result.length.size(); ++i)
        if (result.ends[i] & 1u) least = std::min(least, result.length[i]);
      result.least = std::isfinite(least) ? least : 0;
    }
    simplify(result);
    return result;
  }
  fill_strips(t, result.length);
  check_polygons(t, result.length);
  if (rule == NewKnots::levelling) find_ends(t, result);
  simplify(result);
  return result;
}

KnotSplit new_knots(const KnotIntervals& intervals) {
  KnotSplit split{intervals.owner, intervals.length, std::vector<double>(intervals.length.size())};
  for (size_t i = 0; i < split.length.size(); ++i) {
    const double d = split.length[i];
    split.distance[i] = !is_levelled(intervals, i)      ? d / 2
                        : (intervals.ends[i] & 1u) != 0 ? intervals.least / 2
                                                        : d - intervals.least / 2;
  }
  return split;
}

void simplify(KnotIntervals& intervals) {
  const std::vector<double>& length = intervals.length;
  for (size_t e = 0; e < length.size(); ++e)
    if (length[e] != length[0]) return;
  // Equal ones are not kept so if some will be levelled: now, or behind a first step in halves.
  if (!length.empty() && !intervals.ends.empty() && length[0] != intervals.least)
    for (const std::uint8_t ends : intervals.ends)
      if (ends != 0 && intervals.least != 0) return;
  intervals.length.clear();
  intervals.ends.clear();
}

}  // namespace sublimit
