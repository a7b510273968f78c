// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/piece.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>

#include "sublimit/base/error.h"
#include "sublimit/neighborhood/centre.h"

namespace sublimit {
namespace {

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

/// @param cut_u, cut_v  where the parent is cut
PieceMap quad_map(Span u, Span v, double cut_u = 0.5, double cut_v = 0.5) {
  const auto scale = [](Span span, double cut) { return 1 / (span == Span::upper ? 1 - cut : cut); };
  PieceMap map;
  map.axes = {Axis{0, u, false, scale(u, cut_u)}, Axis{1, v, false, scale(v, cut_v)}};
  return map;
}

/// Where a new knot cuts an edge, from the tail of its half-edge on, as a part of its length.
double cut(HalfEdge h, const Topology& parent, std::span<const LevelStep> steps) {
  const KnotSplit* const knots = steps[0].knots;
  if (!knots) return 0.5;
  const Index e = index(parent.edge(h));
  const double at_tail = knots->distance[e] / knots->length[e];
  return parent.forward(h) ? at_tail : 1 - at_tail;
}

/// Where intervals are of points a piece is what the new knots leave of its point's, and the next ones cut it: how far
/// from the first of these two, as a part of it. Along the edge of a half-edge that leaves the child.
double cut_of_point(HalfEdge h, const Topology& child, const KnotSplit* knots) {
  if (!knots) return 0.5;
  const size_t entry = knot_entry(KnotOwner::point, child, h);
  return 1 - knots->distance[entry] / knots->length[entry];
}

/// Limits next to borders of dual schemes have parameters of their own, which know equal intervals alone.
void check_border(HalfEdge corner, const Topology& t, const KnotSplit* knots) {
  if (!knots) return;
  const double d = knots->length[knot_entry(KnotOwner::point, t, corner)];
  for (const size_t entry :
       {knot_entry(KnotOwner::point, t, corner), other_end(knot_entry(KnotOwner::point, t, t.prev(corner)))})
    if (knots->length[entry] != d || knots->distance[entry] != d / 2)
      throw AnalysisError("next to borders limits are known where knot intervals are equal; boundary none has them");
}

std::vector<PieceChild> of_quad(HalfEdge start, const Topology& parent, std::span<const LevelStep> steps) {
  const Topology& t = steps.back().refinement->topology;
  HalfEdge g[4], h = start;
  for (HalfEdge& at : g) {
    at = at_vertex(h, parent, steps);
    h = parent.next(h);
  }
  const double u = cut(start, parent, steps), v = 1 - cut(parent.prev(start), parent, steps);
  return {{{Piece::Kind::quad, g[0]}, quad_map(Span::lower, Span::lower, u, v)},
          {{Piece::Kind::quad, t.prev(g[1])}, quad_map(Span::upper, Span::lower, u, v)},
          {{Piece::Kind::quad, t.next(t.next(g[2]))}, quad_map(Span::upper, Span::upper, u, v)},
          {{Piece::Kind::quad, t.next(g[3])}, quad_map(Span::lower, Span::upper, u, v)}};
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
  return {{{Piece::Kind::triangle, g0}, with(I.row(0), m0, m2)},
          {{Piece::Kind::triangle, t.prev(g1)}, with(m0, I.row(1), m1)},
          {{Piece::Kind::triangle, t.next(g2)}, with(m2, m1, I.row(2))},
          {{Piece::Kind::triangle, t.twin(t.next(g0))}, with(m2, m0, m1)}};
}

/// Two steps of sqrt3: nine triangles, as long as a third of the parent, six as it lies and three turned by half.
///
/// The first step joins the middle of the triangle to its corners and, across its sides, to the middles beyond; the
/// second puts points at the thirds of the sides, where the first one's triangles have their middles, or on borders.
/// Each half-edge of the first step is then one child, which begins with its tail (Refinement). So the children are
/// known by half-edges alone, whatever the triangle is glued to.
std::vector<PieceChild> of_triangle_in_nine(HalfEdge start, const Topology& parent, std::span<const LevelStep> steps) {
  if (steps.size() != 2 || steps[1].refinement->split != Split::sqrt3 || steps[0].refinement->border_points != 0)
    throw AnalysisError("triangles have nine children after two steps of sqrt3, the second of which trisects borders");
  const Topology &middle = steps[0].refinement->topology, &t = steps[1].refinement->topology;
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const Eigen::RowVector3d centre = I.colwise().mean();
  const auto begins = [](HalfEdge h) { return HalfEdge{3 * index(h)}; };  // its child
  const HalfEdge sides[3] = {start, parent.next(start), parent.prev(start)};
  std::vector<PieceChild> result;
  // Children lie as their parent does: at a corner they then repeat their parents.
  const auto add = [&](HalfEdge h, int position, const Eigen::RowVector3d(&corners)[3]) {
    Eigen::Matrix3d C;
    for (int k = 0; k < 3; ++k) C.row((position + k) % 3) = corners[k];
    for (int k = position; k % 3 != 0; ++k) h = t.next(h);
    result.push_back({{Piece::Kind::triangle, h}, triangle_map(C)});
  };
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const auto third = [&](int from, int to) { return Eigen::RowVector3d((2 * I.row(from) + I.row(to)) / 3); };
    const HalfEdge side = sides[i], before = sides[k], across = parent.twin(side), across_before = parent.twin(before);
    const HalfEdge to_corner = middle.prev(begins(side));
    const HalfEdge from_corner = exists(across_before) ? begins(across_before) : middle.next(begins(before));
    add(begins(from_corner), i, {I.row(i), third(i, j), third(i, k)});
    add(begins(to_corner), i, {centre, third(i, k), third(i, j)});
    // A border's child begins on it.
    const HalfEdge at_side = exists(across) ? begins(middle.next(begins(across))) : t.prev(begins(begins(side)));
    add(at_side, k, {centre, third(i, j), third(j, i)});
  }
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
  if (border_u || border_v) check_border(h, parent, steps.back().knots);
  // Cut where the children's new knots are; next to borders these are in the middle as well.
  const KnotSplit* const knots = steps.back().child_knots;
  const double cut_u = cut_of_point(face, t, knots), cut_v = cut_of_point(before, t, knots);
  const Span far_u = border_u ? Span::beyond : Span::upper, near_u = border_u ? Span::beside : Span::lower;
  const Span far_v = border_v ? Span::beyond : Span::upper, near_v = border_v ? Span::beside : Span::lower;
  std::vector<PieceChild> result;
  const auto add = [&](HalfEdge start, Axis u, Axis v) {
    PieceMap map;
    map.axes = {u, v};
    result.push_back({{Piece::Kind::corner, start}, map});
  };
  const Axis upper_u{0, far_u, false, 1 / (1 - cut_u)}, upper_v{1, far_v, false, 1 / (1 - cut_v)};
  const Axis lower_u{0, near_u, true, 1 / cut_u}, lower_v{1, near_v, true, 1 / cut_v};
  add(face, upper_u, upper_v);
  add(before, upper_v, lower_u);
  if (!folded) add(vertex, lower_u, lower_v);
  add(edge, lower_v, upper_u);
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
    add(along, upper_u, {1, Span::border, false});
    if (rounded)
      add(t.ccw(along), {1, Span::wedge, false}, {1, Span::wedge, false});
    else
      add(t.ccw(along), {1, Span::border, false}, lower_u);
  }
  if (border_u) {
    const HalfEdge inwards = t.prev(before);
    add(inwards, {0, Span::border, false}, upper_v);
    const HalfEdge back = t.next(t.twin(inwards));
    if (rounded)
      add(back, {0, Span::wedge, true}, {0, Span::wedge, true});
    else
      add(back, lower_v, {0, Span::border, false});
  }
  return result;
}

}  // namespace

PieceCoordinates corner_place(Piece::Kind kind, int corner) {
  if (kind == Piece::Kind::triangle) return triangle_place(corner == 1, corner == 2);
  return quad_place(corner == 1 || corner == 2, corner >= 2);
}

int corner_at(Piece::Kind kind, const PieceCoordinates& p) {
  if (kind == Piece::Kind::triangle)
    return p.u == 0 && p.v == 0 ? 0 : p.v == 0 && p.u1 == 0 ? 1 : p.u == 0 && p.u1 == 0 ? 2 : -1;
  if ((p.u != 0 && p.u1 != 0) || (p.v != 0 && p.v1 != 0)) return -1;
  return p.v == 0 ? (p.u == 0 ? 0 : 1) : (p.u == 0 ? 3 : 2);
}

int nearest_corner(Piece::Kind kind, const PieceCoordinates& p) {
  if (kind == Piece::Kind::triangle) return p.u1 >= p.u && p.u1 >= p.v ? 0 : p.u >= p.v ? 1 : 2;
  return nearest_corner(p.u, p.v);
}

std::vector<PieceChild> children(const Piece& piece, const Topology& parent, std::span<const LevelStep> steps) {
  switch (piece.kind) {
    case Piece::Kind::quad:
      return of_quad(piece.start, parent, steps);
    case Piece::Kind::triangle:
      return steps[0].refinement->split == Split::sqrt3 ? of_triangle_in_nine(piece.start, parent, steps)
                                                        : of_triangle_in_four(piece.start, parent, steps);
    case Piece::Kind::cut:
      return {{{Piece::Kind::quad, at_vertex(piece.start, parent, steps)}, quad_map(Span::whole, Span::whole)}};
    default:
      return of_corner(piece.start, parent, steps);
  }
}

}  // namespace sublimit
