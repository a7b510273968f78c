// SPDX-License-Identifier: Apache-2.0
#include "truth/place_descent.h"

#include <algorithm>
#include <stdexcept>

#include "sublimit/base/error.h"

namespace sublimit::testing {
namespace {

/// Quarter of a square that contains the place; the place becomes that of the quarter.
int take_quarter(DescentPlace& p) {
  const Precise half(0.5);
  const int i = p.x >= half, j = p.y >= half;
  p.x = 2 * p.x - i;
  p.y = 2 * p.y - j;
  p.scale *= 2;
  return j == 0 ? i : 3 - i;
}

/// Triangle with these corners, seen from the first.
HalfEdge triangle(const Topology& t, Index a, Index b, Index c) {
  for (Index i = 0; i < t.num_half_edges(); ++i) {
    const HalfEdge h{i};
    if (index(t.tail(h)) == a && index(t.head(h)) == b && index(t.tail(t.prev(h))) == c) return h;
  }
  throw std::logic_error("no triangle has these corners");
}

DescentPlace through_pqq(DescentPlace p, const TakenStep& step) {
  const Topology &t = *step.parent, &child = step.refinement->topology;
  if (p.cell == DescentPlace::Cell::corner) {  // its children start at their own corner
    p.frame = child.corner(Face{index(p.frame)}, 0);
  } else {  // those of a quad lie as their parent
    const Index origin = t.corner_index(p.frame);
    p.frame = child.corner(Face{index(along(t, p.frame, take_quarter(p)))}, origin);
  }
  p.cell = DescentPlace::Cell::square;
  return p;
}

DescentPlace through_ptq(DescentPlace p, const TakenStep& step) {
  const Topology &t = *step.parent, &child = step.refinement->topology;
  const Index origin = t.corner_index(p.frame), first = 4 * index(t.face(p.frame));
  const Precise x = 2 * p.x, y = 2 * p.y;
  p.scale *= 2;
  const auto at_corner = [&](int k) {
    p.x = k == 1 ? Precise(x - 1) : x;
    p.y = k == 2 ? Precise(y - 1) : y;
    p.frame = child.corner(Face{first + (origin + k) % 3}, origin);
  };
  if (x >= 1) {
    at_corner(1);
  } else if (y >= 1) {
    at_corner(2);
  } else if (x + y <= 1) {
    at_corner(0);
  } else {  // the middle one, turned by half a turn
    p.x = 1 - x;
    p.y = 1 - y;
    p.scale = -p.scale;
    p.frame = child.corner(Face{first + 3}, origin);
  }
  return p;
}

/// Two steps cut a triangle into nine. Points are thirds of (x,y): old vertices, the centre, two on every side.
DescentPlace through_sqrt3(DescentPlace p, const TakenStep& even, const TakenStep& odd) {
  const Topology &t = *even.parent, &middle = *odd.parent;
  const Refinement &r1 = *even.refinement, &r2 = *odd.refinement;
  const auto center = [&](HalfEdge h) { return index(r1.child(t.face(h))); };
  // The point of h's side that is nearer to its tail.
  const auto third = [&](HalfEdge h) {
    const Index a = index(t.tail(h)), b = index(t.head(h));
    const HalfEdge g = t.twin(h);
    if (exists(g)) {
      const Index f = index(middle.face(triangle(middle, a, center(g), center(h))));
      if (r2.face_list.empty()) return index(r2.child(Face{f}));
      return r2.from_vertices +
             Index(std::lower_bound(r2.face_list.begin(), r2.face_list.end(), f) - r2.face_list.begin());
    }
    const Index border = index(triangle(middle, a, b, center(h)));
    const auto rank = std::lower_bound(r2.borders.begin(), r2.borders.end(), border) - r2.borders.begin();
    return r2.first_border_child() + 2 * Index(rank);
  };
  const auto far_third = [&](HalfEdge h) { return exists(t.twin(h)) ? third(t.twin(h)) : third(h) + 1; };
  const HalfEdge side[] = {p.frame, t.next(p.frame), t.prev(p.frame)};
  const auto point = [&](int i, int j) {
    if (i == 1 && j == 1) return center(p.frame);
    if (j == 0)
      return i == 0   ? index(t.tail(side[0]))
             : i == 1 ? third(side[0])
             : i == 2 ? far_third(side[0])
                      : index(t.tail(side[1]));
    if (i == 0) return j == 3 ? index(t.tail(side[2])) : j == 2 ? third(side[2]) : far_third(side[2]);
    return i == 2 ? third(side[1]) : far_third(side[1]);
  };
  const Precise x = 3 * p.x, y = 3 * p.y;
  int i = std::min(static_cast<int>(x), 2), j = std::min(static_cast<int>(y), 2);
  if (i + j > 2) --(i > 0 ? i : j);  // on the far side, at a point
  p.x = x - i;
  p.y = y - j;
  p.scale *= 3;
  if (p.x + p.y <= 1) {
    p.frame = triangle(r2.topology, point(i, j), point(i + 1, j), point(i, j + 1));
  } else {
    p.x = 1 - p.x;
    p.y = 1 - p.y;
    p.scale = -p.scale;
    p.frame = triangle(r2.topology, point(i + 1, j + 1), point(i, j + 1), point(i + 1, j));
  }
  return p;
}

/// Where a corner's point is after a level of a dual scheme, as the half-edge of the face that descends from the
/// corner's.
HalfEdge dual_child(HalfEdge h, std::span<const TakenStep> steps) {
  const Topology& t = *steps[0].parent;
  if (steps[0].refinement->split == Split::dqq) return h;
  if (steps[0].refinement->split == Split::mid_edge)
    return t.prev(h);  // the side that cuts the corner off, then its middle
  // Repeated averaging: the child quad of the corner becomes a point, the face's point a face.
  const Refinement& last = *steps.back().refinement;
  const Index quad = index(h), from_face = index(steps[0].refinement->child(t.face(h)));
  const Face face{last.face_of_vertex[from_face]};
  for (Index k = 0; k < last.topology.size(face); ++k)
    if (const HalfEdge g = last.topology.corner(face, k); index(last.topology.tail(g)) == quad) return g;
  throw std::logic_error("the point of a quad is not in the face of its corner");
}

DescentPlace through_dual(DescentPlace p, std::span<const TakenStep> steps) {
  const Topology &t = *steps[0].parent, &child = steps.back().refinement->topology;
  HalfEdge corner = p.frame;
  int seen = 2;  // corner of the new square at which the face's centre is
  if (p.cell == DescentPlace::Cell::square) {
    const int quarter = take_quarter(p);
    corner = along(t, p.frame, quarter);
    seen = (quarter + 2) % 4;
  } else if (p.cell == DescentPlace::Cell::around_vertex) {
    seen = take_quarter(p);
    corner = turned(t, p.frame, seen);
  }
  p.frame = turned(child, dual_child(corner, steps), -seen);
  p.cell = DescentPlace::Cell::around_vertex;
  return p;
}

}  // namespace

DescentPlace place_of(const Topology& control, bool triangles, const Place& place) {
  const Addresses addresses(control, triangles);
  if (place.face < 0 || place.face >= addresses.size())
    throw InvalidParameter("address " + std::to_string(place.face) + " does not exist");
  const auto [face, corner] = addresses.place(place.face);
  const bool inside =
      place.u >= 0 && place.v >= 0 && (triangles ? place.u + place.v <= 1 : place.u <= 1 && place.v <= 1);
  if (!inside) throw InvalidParameter("the place is outside its square or triangle");
  DescentPlace p;
  p.cell = triangles    ? DescentPlace::Cell::triangle
           : corner < 0 ? DescentPlace::Cell::square
                        : DescentPlace::Cell::corner;
  p.frame = control.corner(face, std::max<Index>(corner, 0));
  p.x = place.u;
  p.y = place.v;
  return p;
}

DescentPlace descend(const DescentPlace& place, std::span<const TakenStep> steps) {
  const Split last = steps.back().refinement->split;
  if (last == Split::dqq || last == Split::mid_edge || last == Split::dual) return through_dual(place, steps);
  if (last == Split::sqrt3) return through_sqrt3(place, steps[0], steps[1]);
  DescentPlace p = place;
  for (const TakenStep& step : steps) {
    const Split split = step.refinement->split;
    if (split == Split::quads)
      throw UnsupportedTopology("addresses of polygons have no meaning where edges become quads");
    if (split == Split::pqq) p = through_pqq(p, step);
    if (split == Split::ptq) p = through_ptq(p, step);
  }
  return p;
}

}  // namespace sublimit::testing
