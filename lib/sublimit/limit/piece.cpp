// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/piece.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <unordered_map>

#include "sublimit/analysis/centre.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Kind = Piece::Kind;
using Axis = PieceMap::Axis;

Centre followed(Centre centre, const Topology& parent, std::span<const LevelStep> steps) {
  const Topology* t = &parent;
  for (const LevelStep& step : steps) {
    centre = child(centre, *t, *step.refinement, step.level);
    t = &step.refinement->topology;
  }
  return centre;
}

/// The half-edge that lies at the child of h's tail as h lies at its tail: primal schemes.
HalfEdge at_vertex(HalfEdge h, const Topology& parent, std::span<const LevelStep> steps) {
  HalfEdge first = h;
  int turns = 0;
  while (exists(parent.twin(first))) {
    first = parent.next(parent.twin(first));
    ++turns;
    if (first == h) break;
  }
  if (exists(parent.twin(first))) return followed({Centre::Kind::vertex, h}, parent, steps).start;
  // Open fans are followed by their first half-edge.
  const Topology& t = steps.back().refinement->topology;
  HalfEdge at = followed({Centre::Kind::vertex, first}, parent, steps).start;
  for (int k = 0; k < turns; ++k) at = t.ccw(at);
  return at;
}

PieceMap quad_map(Span u, Span v) {
  PieceMap map;
  map.axes = {Axis{0, u, false}, Axis{1, v, false}};
  return map;
}

std::vector<PieceChild> of_quad(HalfEdge start, const Topology& parent, std::span<const LevelStep> steps) {
  const Topology& t = steps.back().refinement->topology;
  HalfEdge g[4], h = start;
  for (HalfEdge& at : g) {
    at = at_vertex(h, parent, steps);
    h = parent.next(h);
  }
  return {{{Kind::quad, g[0]}, quad_map(Span::lower, Span::lower)},
          {{Kind::quad, t.prev(g[1])}, quad_map(Span::upper, Span::lower)},
          {{Kind::quad, t.next(t.next(g[2]))}, quad_map(Span::upper, Span::upper)},
          {{Kind::quad, t.next(g[3])}, quad_map(Span::lower, Span::upper)}};
}

/// @param corners  barycentric coordinates of the child's corners in the parent, in the order of the piece
PieceMap triangle_map(const Eigen::Matrix3d& corners) {
  PieceMap map;
  map.is_triangle = true;
  const Eigen::Matrix3d inverse = corners.transpose().inverse();  // whole numbers
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) map.barycentric[i][j] = std::round(inverse(i, j));
  return map;
}

std::vector<PieceChild> of_triangle_in_four(HalfEdge start, const Topology& parent, std::span<const LevelStep> steps) {
  const Topology& t = steps.back().refinement->topology;
  const HalfEdge h1 = parent.next(start), h2 = parent.next(h1);
  const HalfEdge g0 = at_vertex(start, parent, steps), g1 = at_vertex(h1, parent, steps),
                 g2 = at_vertex(h2, parent, steps);
  Eigen::Matrix3d I = Eigen::Matrix3d::Identity(), C;
  const Eigen::RowVector3d m0 = (I.row(0) + I.row(1)) / 2, m1 = (I.row(1) + I.row(2)) / 2,
                           m2 = (I.row(2) + I.row(0)) / 2;
  const auto with = [&](const Eigen::RowVector3d& a, const Eigen::RowVector3d& b, const Eigen::RowVector3d& c) {
    C << a, b, c;
    return triangle_map(C);
  };
  return {{{Kind::triangle, g0}, with(I.row(0), m0, m2)},
          {{Kind::triangle, t.prev(g1)}, with(m0, I.row(1), m1)},
          {{Kind::triangle, t.next(g2)}, with(m2, m1, I.row(2))},
          {{Kind::triangle, t.twin(t.next(g0))}, with(m2, m0, m1)}};
}

/// Two steps of sqrt3: nine triangles, found by where their corners lie in the parent.
std::vector<PieceChild> of_triangle_in_nine(HalfEdge start, const Topology& parent, std::span<const LevelStep> steps) {
  using Label = Eigen::RowVector3d;
  std::unordered_map<Index, Label> labels;  // of vertices of the level before; several if a mesh is glued to itself
  std::vector<std::pair<HalfEdge, std::array<Label, 3>>>
      triangles;  // of that level, each by a half-edge and its corners
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  triangles.push_back({start, {I.row(0), I.row(1), I.row(2)}});
  HalfEdge h = start;
  for (int i = 0; i < 3; ++i, h = parent.next(h))
    if (const HalfEdge g = parent.twin(h); exists(g)) {
      const Label a = I.row(i), b = I.row((i + 1) % 3), c = I.row((i + 2) % 3);
      triangles.push_back({g, {b, a, a + b - c}});
    }
  const Topology* before = &parent;
  for (const LevelStep& step : steps) {
    const Refinement& r = *step.refinement;
    const Topology& t = r.topology;
    // Corners of the new triangles around each old one's half-edges, in its own chart.
    std::vector<std::pair<HalfEdge, std::array<Label, 3>>> next;
    for (const auto& [first, corners] : triangles) {
      std::unordered_map<Index, Label> at;  // child vertices in this chart
      const Label middle = (corners[0] + corners[1] + corners[2]) / 3;
      HalfEdge side = first;
      std::vector<Index> old;
      for (int i = 0; i < 3; ++i, side = before->next(side)) {
        const Index v = index(before->tail(side));
        at[v] = corners[i];
        old.push_back(v);
        const Label& b = corners[(i + 1) % 3];
        if (!exists(before->twin(side)) && r.border_points == 2) {
          const auto rank = std::lower_bound(r.borders.begin(), r.borders.end(), index(side)) - r.borders.begin();
          const Index p = r.first_border_child() + 2 * static_cast<Index>(rank);
          at[p] = (2 * corners[i] + b) / 3;
          at[p + 1] = (corners[i] + 2 * b) / 3;
        }
        // The point across this side, if there is one.
        if (const HalfEdge g = before->twin(side); exists(g)) {
          const Label c = corners[(i + 2) % 3], across = corners[i] + b - c;
          const Index f = index(before->face(g));
          for (Index k = r.from_vertices; k < r.from_vertices + r.from_faces; ++k)
            if (r.parent(Vertex{k}) == f) at[k] = (corners[i] + b + across) / 3;
        }
      }
      const Index own = index(before->face(first));
      for (Index k = r.from_vertices; k < r.from_vertices + r.from_faces; ++k)
        if (r.parent(Vertex{k}) == own) at[k] = middle;
      // Faces all of whose corners are known here.
      for (const auto& [v, label] : at)
        for (const HalfEdge fan : t.fans(Vertex{v})) {
          HalfEdge g = fan;
          do {
            std::array<Label, 3> found;
            HalfEdge k = g;
            int known = 0;
            for (int i = 0; i < 3; ++i, k = t.next(k))
              if (const auto place = at.find(index(t.tail(k))); place != at.end()) found[i] = place->second, ++known;
            if (known == 3) next.push_back({g, found});
            g = t.ccw(g);
          } while (exists(g) && g != fan);
        }
    }
    triangles = std::move(next);
    before = &t;
  }
  std::vector<PieceChild> result;
  std::vector<Index> seen;
  for (const auto& [g, corners] : triangles) {
    Eigen::Matrix3d C;
    C << corners[0], corners[1], corners[2];
    const Label centre = C.colwise().mean();
    if (centre.minCoeff() <= 0 || std::abs(C.determinant() - 1.0 / 9) > 1e-9) continue;
    const Index f = index(before->face(g));
    if (std::find(seen.begin(), seen.end(), f) != seen.end()) continue;
    seen.push_back(f);
    result.push_back({{Kind::triangle, g}, triangle_map(C)});
  }
  if (result.size() != 9) throw AnalysisError("nine triangles do not tile their parent");
  return result;
}

std::vector<PieceChild> of_corner(HalfEdge h, const Topology& parent, std::span<const LevelStep> steps) {
  const Topology& t = steps.back().refinement->topology;
  const HalfEdge face = followed({Centre::Kind::face, h}, parent, steps).start;
  const HalfEdge before = t.ccw(face), vertex = exists(before) ? t.ccw(before) : no_half_edge;
  const HalfEdge edge = exists(vertex) ? t.ccw(vertex) : no_half_edge;
  if (!exists(edge)) throw AnalysisError("a corner's point has not four faces");
  const bool border_u = !exists(parent.twin(parent.prev(h))), border_v = !exists(parent.twin(h));
  const Span far_u = border_u ? Span::beyond : Span::upper, near_u = border_u ? Span::beside : Span::lower;
  const Span far_v = border_v ? Span::beyond : Span::upper, near_v = border_v ? Span::beside : Span::lower;
  std::vector<PieceChild> result;
  const auto add = [&](HalfEdge start, Axis u, Axis v) {
    PieceMap map;
    map.axes = {u, v};
    result.push_back({{Kind::corner, start}, map});
  };
  add(face, {0, far_u, false}, {1, far_v, false});
  add(before, {1, far_v, false}, {0, near_u, true});
  add(vertex, {0, near_u, true}, {1, near_v, true});
  add(edge, {1, near_v, true}, {0, far_u, false});
  const bool rounded = border_u && border_v;
  if (border_v) {  // the two at the border point of this edge, on either side of it
    const HalfEdge along = t.next(edge);
    add(along, {0, far_u, false}, {1, Span::border, false});
    if (rounded)
      add(t.ccw(along), {1, Span::wedge, false}, {1, Span::wedge, false});
    else
      add(t.ccw(along), {1, Span::border, false}, {0, near_u, true});
  }
  if (border_u) {
    const HalfEdge inwards = t.prev(before);
    add(inwards, {0, Span::border, false}, {1, far_v, false});
    const HalfEdge back = t.next(t.twin(inwards));
    if (rounded)
      add(back, {0, Span::wedge, true}, {0, Span::wedge, true});
    else
      add(back, {1, near_v, true}, {0, Span::border, false});
  }
  return result;
}

}  // namespace

std::vector<PieceChild> children(const Piece& piece, const Topology& parent, std::span<const LevelStep> steps) {
  switch (piece.kind) {
    case Kind::quad:
      return of_quad(piece.start, parent, steps);
    case Kind::triangle:
      return steps[0].refinement->split == Split::sqrt3 ? of_triangle_in_nine(piece.start, parent, steps)
                                                        : of_triangle_in_four(piece.start, parent, steps);
    case Kind::cut:
      return {{{Kind::quad, at_vertex(piece.start, parent, steps)}, quad_map(Span::whole, Span::whole)}};
    default:
      return of_corner(piece.start, parent, steps);
  }
}

}  // namespace sublimit
