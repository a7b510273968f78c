// SPDX-License-Identifier: Apache-2.0
#include "truth/brute_force.h"

#include <algorithm>

#include "sublimit/scheme/detail/refine_impl.h"

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

/// What a step depends on: where it is as before, so are the weights of the next one. Under sqrt3 every second step is
/// another one on borders, where the number of faces takes turns too, so that no state follows itself.
struct State {
  std::vector<HalfEdge> corners;
  Vertex centre;
  std::vector<Index> sizes = {}, vertices = {}, holes = {};
  std::vector<float> edges = {}, points = {};
  friend bool operator==(const State&, const State&) = default;
};
State state(const Level& level, const std::vector<HalfEdge>& corners, Vertex centre) {
  State all{.corners = corners, .centre = centre};
  const Topology& t = level.topology();
  for (Index f = 0; f < t.num_faces(); ++f) {
    all.sizes.push_back(t.size(Face{f}));
    for (const Index v : t.vertices(Face{f})) all.vertices.push_back(v);
  }
  all.holes.assign(level.holes.begin(), level.holes.end());
  all.edges.assign(level.sharpness.edge.begin(), level.sharpness.edge.end());
  all.points.assign(level.sharpness.vertex.begin(), level.sharpness.vertex.end());
  return all;
}

}  // namespace

std::vector<RefinedRing> brute_force(const Scheme<Precise>& scheme, const Level& level, const Points& points, Vertex v,
                                     const std::vector<int>& depths) {
  std::vector<RefinedRing> result;
  RefinedRing ring;
  std::vector<HalfEdge> corners = corners_at(level.topology(), v);
  if (corners.empty()) return result;
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
  // The same corners in the part.
  const auto moved = [&](const Topology& from, const Subset& to, std::vector<HalfEdge> halves) {
    for (HalfEdge& h : halves)
      h = to.level.topology().corner(Face{position(to.parents, index(from.face(h)))}, from.corner_index(h));
    return halves;
  };
  Vertex centre{position(vertices, index(v))};
  corners = moved(level.topology(), part, corners);

  // Offsets from the vertex: rows sum to one, so they refine as points do, and keep their digits at any depth.
  const auto recentre = [&](Vertex at) {
    const Eigen::Matrix<Precise, 1, 3> moved_by = ring.points.row(index(at));
    ring.position += moved_by;
    for (Eigen::Index i = 0; i < ring.points.rows(); ++i) ring.points.row(i) -= moved_by;
  };
  recentre(centre);
  const auto keep = [&](int k) {
    if (std::find(depths.begin(), depths.end(), k) == depths.end()) return;
    ring.level = part.level;
    ring.vertex = centre;
    ring.corners = corners;
    result.push_back(ring);
  };
  State before = state(part.level, corners, centre);
  for (int k = 1; k <= depths.back(); ++k) {
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
    recentre(centre);
    corners = moved(plain.topology(), part, corners);
    keep(k);
    State after = state(part.level, corners, centre);
    if (after == before) {  // and so it stays: the same weights, again and again
      PrecisePoints refined_again(ring.points.rows(), 3);
      while (++k <= depths.back()) {
        for (size_t i = 0; i < vertices.size(); ++i) {
          refined_again.row(Index(i)).setZero();
          for (decltype(next.S)::InnerIterator it(next.S, vertices[i]); it; ++it)
            refined_again.row(Index(i)) += it.value() * ring.points.row(it.col());
        }
        ring.points.swap(refined_again);
        recentre(centre);
        keep(k);
      }
    }
    before = std::move(after);
  }
  return result;
}

}  // namespace sublimit::testing
