// SPDX-License-Identifier: Apache-2.0
#include "support/brute_force.h"

#include <algorithm>

#include "sublimit/refine_impl.h"

namespace sublimit::testing {
namespace {

std::vector<HalfEdge> corners_at(const Topology& t, Vertex v) {
  std::vector<HalfEdge> corners;
  for (const HalfEdge start : t.fans(v)) {
    HalfEdge h = start;
    do {
      corners.push_back(h);
      h = t.ccw(h);
    } while (exists(h) && h != start);
  }
  return corners;
}

/// Faces at a vertex, each once.
std::vector<Index> faces_at(const Topology& t, const std::vector<HalfEdge>& corners) {
  std::vector<Index> faces;
  for (const HalfEdge h : corners) faces.push_back(index(t.face(h)));
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

}  // namespace

RefinedRing brute_force(const Scheme<Precise>& scheme, const Level& level, const Points& points, Vertex v, int steps) {
  RefinedRing ring;
  std::vector<HalfEdge> corners = corners_at(level.topology(), v);
  if (corners.empty()) return ring;
  Subset part = subset(level, faces_at(level.topology(), corners));
  const auto selected = [](const SparseMatrix& S) {  // the one column of each row of a selection
    return std::vector<Index>(S.innerIndexPtr(), S.innerIndexPtr() + S.nonZeros());
  };
  std::vector<Index> vertices = selected(part.level.S);
  ring.points.resize(Index(vertices.size()), 3);
  for (size_t i = 0; i < vertices.size(); ++i)
    for (int c = 0; c < 3; ++c) ring.points(Index(i), c) = Precise(points(vertices[i], c));
  const auto position = [](const std::vector<Index>& list, Index i) {
    return Index(std::lower_bound(list.begin(), list.end(), i) - list.begin());
  };
  // The same corners in the part: its faces keep their order and their corners.
  const auto moved = [&](const Topology& from, const Topology& to, const std::vector<HalfEdge>& halves,
                         const std::vector<Index>& from_vertices, Vertex centre) {
    // Faces are found by their vertices in the whole: unique around one vertex unless faces coincide entirely.
    std::vector<HalfEdge> result;
    for (const HalfEdge h : halves) {
      HalfEdge match = no_half_edge;
      for (const HalfEdge g : corners_at(to, centre)) {
        if (to.size(to.face(g)) != from.size(from.face(h))) continue;
        bool same = true;
        HalfEdge a = h, b = g;
        for (Index k = 0; k < to.size(to.face(g)); ++k, a = from.next(a), b = to.next(b))
          same &= from_vertices[index(to.tail(b))] == index(from.tail(a));
        if (same) match = g;
      }
      result.push_back(match);
    }
    return result;
  };
  Vertex centre{position(vertices, index(v))};
  corners = moved(level.topology(), part.level.topology(), corners, vertices, centre);

  for (int k = 0; k < steps; ++k) {
    LevelOf<Precise> from;
    from.number = part.level.number;
    from.steps = part.level.steps;
    from.sharpness = part.level.sharpness;
    from.holes = part.level.holes;
    LevelOf<Precise> next = next_level(scheme, from);
    const Refinement& r = next.steps[0];
    for (HalfEdge& h : corners) h = r.halves(from.topology(), h).first;
    const PrecisePoints refined = next.S * ring.points;
    Level plain;
    plain.number = next.number;
    plain.steps = next.steps;
    plain.sharpness = next.sharpness;
    plain.holes = next.holes;
    const Vertex child = r.child(centre);
    part = subset(plain, faces_at(plain.topology(), corners));
    vertices = selected(part.level.S);
    PrecisePoints kept(Index(vertices.size()), 3);
    for (size_t i = 0; i < vertices.size(); ++i) kept.row(Index(i)) = refined.row(vertices[i]);
    ring.points = std::move(kept);
    centre = Vertex{position(vertices, index(child))};
    corners = moved(plain.topology(), part.level.topology(), corners, vertices, centre);
  }
  ring.level = std::move(part.level);
  ring.vertex = centre;
  ring.corners = std::move(corners);
  return ring;
}

}  // namespace sublimit::testing
