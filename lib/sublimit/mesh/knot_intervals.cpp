// SPDX-License-Identifier: Apache-2.0
#include "sublimit/mesh/knot_intervals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/base/format_number.h"
#include "sublimit/mesh/sharpness.h"

namespace sublimit {
namespace {

std::string edge_name(Index a, Index b) {
  const auto [low, high] = std::minmax(a, b);
  return "(" + std::to_string(low) + "," + std::to_string(high) + ")";
}
std::string edge_name(const Topology& t, Index e) { return edge_name(index(t.tail(Edge{e})), index(t.head(Edge{e}))); }

/// Intervals as given, 0 where none is.
std::vector<double> given_lengths(const Topology& t, const ControlMesh& mesh) {
  std::vector<double> length(t.num_edges(), 0);
  for (const ControlMesh::KnotInterval& given : mesh.knot_intervals) {
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
    if (given.length == 0)
      fail("it is 0; strips of interval 0 are not refined: merge their two sides, and for a sharp line there tag its " +
           std::string("edges as creases, as in 't crease 2/1/0 ") + std::to_string(given.tail) + " " +
           std::to_string(given.head) + " 10'");
    double& own = length[index(e)];
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
bool is_extraordinary(const Topology& t, Vertex v) {
  if (t.is_isolated(v)) return false;
  if (t.is_nonmanifold(v)) return true;
  const bool boundary = !exists(t.twin(t.outgoing(v)));
  return boundary ? t.num_faces(v) > 2 : t.num_faces(v) != 4;
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

/// Whether levelling moves the new knot of an edge from the middle.
bool is_levelled(const KnotIntervals& intervals, size_t e) {
  if (intervals.plain || intervals.ends.empty()) return false;
  const unsigned ends = intervals.ends[e] & 3u;
  return (ends == 1 || ends == 2) && intervals.length[e] != intervals.least;
}

}  // namespace

KnotIntervals initial_intervals(const Topology& t, const ControlMesh& mesh, NewKnots rule) {
  KnotIntervals result;
  if (mesh.knot_intervals.empty() || rule == NewKnots::none) return result;
  result.length = given_lengths(t, mesh);
  fill_strips(t, result.length);
  check_polygons(t, result.length);
  if (rule == NewKnots::levelling) find_ends(t, result);
  simplify(result);
  return result;
}

KnotSplit new_knots(const KnotIntervals& intervals) {
  KnotSplit split{intervals.length, std::vector<double>(intervals.length.size())};
  for (size_t e = 0; e < split.length.size(); ++e) {
    const double d = split.length[e];
    split.at_tail[e] = !is_levelled(intervals, e)      ? d / 2
                       : (intervals.ends[e] & 1u) != 0 ? intervals.least / 2
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
