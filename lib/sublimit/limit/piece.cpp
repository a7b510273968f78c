// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/piece.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <string>
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

/// A triangle of some level between the parent and its children, and where its corners lie in the parent.
struct Labelled {
  HalfEdge first;
  std::array<Eigen::RowVector3d, 3> corners;
};

/// The triangles of the next level whose corners are known from these: a vertex keeps its place, a face has its point
/// in the middle, a border that is trisected has its points at thirds.
std::vector<Labelled> next_triangles(const std::vector<Labelled>& triangles, const Topology& t, const Refinement& r) {
  using Label = Eigen::RowVector3d;
  std::unordered_map<Index, Index> point_of;  // child vertex of a face
  for (Index k = r.from_vertices; k < r.from_vertices + r.from_faces; ++k) point_of[r.parent(Vertex{k})] = k;
  std::vector<Labelled> result;
  const auto add_known = [&](HalfEdge g, const std::unordered_map<Index, Label>& at) {
    Labelled found{g, {}};
    for (Label& corner : found.corners) {
      const auto place = at.find(index(r.topology.tail(g)));
      if (place == at.end()) return;
      corner = place->second;
      g = r.topology.next(g);
    }
    const auto centre = [](const Labelled& one) { return Label(one.corners[0] + one.corners[1] + one.corners[2]); };
    for (const Labelled& other : result)
      if (r.topology.face(other.first) == r.topology.face(found.first) && (centre(other) - centre(found)).norm() < 1e-9)
        return;
    result.push_back(found);
  };
  for (const Labelled& triangle : triangles) {
    // Child vertices in it and across one of its sides; where a mesh is glued to itself, in it.
    HalfEdge side = triangle.first;
    for (int i = 0; i < 3; ++i, side = t.next(side)) {
      std::unordered_map<Index, Label> at;
      const auto add_inside = [&](const Labelled& one) {
        if (const auto k = point_of.find(index(t.face(one.first))); k != point_of.end())
          at[k->second] = (one.corners[0] + one.corners[1] + one.corners[2]) / 3;
        HalfEdge h = one.first;
        for (int c = 0; c < 3; ++c, h = t.next(h)) {
          at[index(t.tail(h))] = one.corners[c];
          if (exists(t.twin(h)) || r.border_points != 2) continue;
          const auto rank = std::lower_bound(r.borders.begin(), r.borders.end(), index(h)) - r.borders.begin();
          const Index p = r.first_border_child() + 2 * static_cast<Index>(rank);
          at[p] = (2 * one.corners[c] + one.corners[(c + 1) % 3]) / 3;
          at[p + 1] = (one.corners[c] + 2 * one.corners[(c + 1) % 3]) / 3;
        }
      };
      if (const HalfEdge g = t.twin(side); exists(g)) {
        const Label &a = triangle.corners[i], &b = triangle.corners[(i + 1) % 3], &c = triangle.corners[(i + 2) % 3];
        Labelled across{g, {b, a, a + b - c}};
        for (const Labelled& known : triangles) {  // at borders it may lie elsewhere than the lattice has it
          if (t.face(known.first) != t.face(g)) continue;
          int turn = 0;
          for (HalfEdge h = known.first; h != g; h = t.next(h)) ++turn;
          const Label &p = known.corners[turn], &q = known.corners[(turn + 1) % 3];
          if ((p - b).norm() + (q - a).norm() < 1e-9) across.corners[2] = known.corners[(turn + 2) % 3];
        }
        add_inside(across);
      }
      add_inside(triangle);
      for (const auto& [v, label] : at)
        for (const HalfEdge fan : r.topology.fans(Vertex{v})) {
          HalfEdge g = fan;
          do {
            add_known(g, at);
            g = r.topology.ccw(g);
          } while (exists(g) && g != fan);
        }
    }
  }
  return result;
}

/// Two steps of sqrt3: nine triangles, found by where their corners lie in the parent.
std::vector<PieceChild> of_triangle_in_nine(HalfEdge start, const Topology& parent, std::span<const LevelStep> steps) {
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  std::vector<Labelled> triangles{{start, {I.row(0), I.row(1), I.row(2)}}};
  HalfEdge h = start;
  for (int i = 0; i < 3; ++i, h = parent.next(h))
    if (const HalfEdge g = parent.twin(h); exists(g)) {
      const Eigen::RowVector3d a = I.row(i), b = I.row((i + 1) % 3), c = I.row((i + 2) % 3);
      triangles.push_back({g, {b, a, a + b - c}});
    }
  const Topology* before = &parent;
  for (const LevelStep& step : steps) {
    triangles = next_triangles(triangles, *before, *step.refinement);
    before = &step.refinement->topology;
  }
  std::vector<PieceChild> result;
  for (const auto& [first, corners] : triangles) {
    // As the parent lies, where a side is parallel to its first one: at a corner children then repeat their parents.
    int begin = 0;
    for (int i = 0; i < 3; ++i) {
      const Eigen::RowVector3d side = corners[(i + 1) % 3] - corners[i];
      if (std::abs(side[2]) < 1e-9 && std::abs(side[0] + side[1]) < 1e-9) begin = i;
    }
    HalfEdge h0 = first;
    for (int i = 0; i < begin; ++i) h0 = before->next(h0);
    Eigen::Matrix3d C;
    C << corners[begin], corners[(begin + 1) % 3], corners[(begin + 2) % 3];
    if (C.colwise().mean().minCoeff() <= 0 || std::abs(C.determinant() - 1.0 / 9) > 1e-9) continue;
    result.push_back({{Kind::triangle, h0}, triangle_map(C)});
  }
  if (result.size() != 9)
    throw AnalysisError("a triangle has " + std::to_string(result.size()) + " children, not nine");
  return result;
}

std::vector<PieceChild> of_corner(HalfEdge h, const Topology& parent, std::span<const LevelStep> steps) {
  const Topology& t = steps.back().refinement->topology;
  const HalfEdge face = followed({Centre::Kind::face, h}, parent, steps).start;
  const HalfEdge before = t.ccw(face), vertex = exists(before) ? t.ccw(before) : no_half_edge;
  HalfEdge edge = exists(vertex) ? t.ccw(vertex) : no_half_edge;
  const bool folded = edge == face;  // two faces only at the corner, glued along two edges
  if (folded) edge = vertex;
  if (!exists(edge) || t.ccw(edge) != face) throw AnalysisError("a corner's point has not four faces");
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
  if (!folded) add(vertex, {0, near_u, true}, {1, near_v, true});
  add(edge, {1, near_v, true}, {0, far_u, false});
  if (folded) add(edge, {0, Span::fold, false}, {0, Span::fold, false});
  const bool rounded = border_u && border_v;
  if (HalfEdge first = h; !border_u && !border_v) {  // clockwise to where the fan begins, if it is open
    do first = parent.next(parent.twin(first));
    while (exists(parent.twin(first)) && first != h);
    if (!exists(parent.twin(first))) {
      for (PieceChild& child : result) child.map.radial = true;
      // The point on the border is the one before the corners' points, around their face.
      HalfEdge at = vertex;
      for (HalfEdge k = first; k != h; k = parent.ccw(k)) at = t.prev(at);
      add(t.prev(at), {0, Span::spoke, false}, {0, Span::spoke, false});
    }
  }
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
