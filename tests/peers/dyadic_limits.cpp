// SPDX-License-Identifier: Apache-2.0
#include "peers/dyadic_limits.h"

#include <cmath>
#include <utility>

#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/limit/detail/limit_points.h"

namespace sublimit::testing {
namespace {

/// A quadrilateral with the faces around it, and their points.
struct Patch {
  Subset part;
  Points points;
};

Patch around(const Level& level, const Points& points, Index face, int rings) {
  Patch patch{subset(level, std::vector<Index>{face}, rings), {}};
  patch.points = apply(patch.part.level.S, points);
  return patch;
}

/// Its children.
Patch refined(const Scheme<double>& scheme, const Patch& patch) {
  Patch fine{refine(scheme, patch.part), {}};
  fine.points = apply(fine.part.level.S, patch.points);
  return fine;
}

Patch child(const Scheme<double>& scheme, const Patch& patch, Index number) {
  const Patch fine = refined(scheme, patch);
  return around(fine.part.level, fine.points, fine.part.faces[number], rings_for_refinement(scheme));
}

/// (s,t) along the edges of a corner, as (u,v).
Place from_corner(const SquareCorner& c, double s, double t) {
  switch (c.corner) {
    case 0:
      return {c.address, s, t};
    case 1:
      return {c.address, 1 - t, s};
    case 2:
      return {c.address, 1 - s, 1 - t};
    default:
      return {c.address, t, 1 - s};
  }
}

SquareCorner::Kind kind(const Level& level, Vertex v) {
  using Kind = SquareCorner::Kind;
  const Topology& t = level.topology();
  const std::vector<HalfEdge> fans = t.fans(v);
  const VertexSharpness sharpness(t, level.sharpness, v);
  bool all_infinite = true;
  std::vector<size_t> sharp;
  for (size_t i = 0; i < sharpness.edges.size(); ++i) {
    if (!is_sharp(sharpness.edges[i])) continue;
    sharp.push_back(i);
    all_infinite = all_infinite && is_infinite(sharpness.edges[i]);
  }
  const size_t n = sharpness.edges.size();
  if (sharp.empty() && !is_sharp(sharpness.vertex)) return n == 4 && fans.size() == 1 ? Kind::regular : Kind::smooth;
  const bool straight =
      fans.size() == 1 && sharp.size() == 2 && (n == 4 ? sharp[1] - sharp[0] == 2 : n == 3 && sharp[1] - sharp[0] == 2);
  return straight && all_infinite && !is_sharp(sharpness.vertex) ? Kind::regular : Kind::sharp;
}

}  // namespace

DyadicLimits::DyadicLimits(const Scheme<double>& scheme, const Mesh& mesh)
    : scheme_(scheme),
      points_(mesh.positions),
      level_(control_level(scheme, mesh)),
      addresses_(level_.topology(), false),
      cache_(scheme) {}

std::vector<SquareCorner> DyadicLimits::corners() const {
  const Level first = next_level(scheme_, level_);
  std::vector<SquareCorner> list;
  for (Index a = 0; a < addresses_.size(); ++a) {
    const auto [face, corner] = addresses_.place(a);
    if (level_.holes[index(face)]) continue;
    // A square of a polygon is a child of it, with the polygon's corner first.
    const Level& level = corner < 0 ? level_ : first;
    const Face square = corner < 0 ? face : Face{index(level_.topology().corner(face, corner))};
    for (Index c = 0; c < 4; ++c) list.push_back({a, c, kind(level, Vertex{level.topology().vertices(square)[c]})});
  }
  return list;
}

std::vector<DyadicLimit> DyadicLimits::towards(const SquareCorner& c, int last) {
  const auto [face, polygon_corner] = addresses_.place(c.address);
  Patch patch = around(level_, points_, index(face), rings_for_refinement(scheme_));
  if (polygon_corner >= 0) patch = child(scheme_, patch, polygon_corner);
  std::vector<DyadicLimit> limits;
  for (int k = 1; k <= last; ++k) {
    patch = child(scheme_, patch, c.corner);
    const Patch fine = refined(scheme_, patch);
    const Topology& t = fine.part.level.topology();
    const LimitMatrices matrices = limit_matrices(fine.part.level, cache_);
    const LimitPoints made = limit_points(matrices, t, fine.points);
    const double a = std::ldexp(1, -k);
    // Children and their corners are numbered as the corners of the parent.
    const auto add = [&](Index child_number, Index at, double s, double v) {
      const Index next = (c.corner + child_number) % 4, position = (c.corner + at) % 4;
      const HalfEdge h = t.corner(Face{fine.part.faces[next]}, position);
      const Index side = matrices.corner_side[index(h)];
      limits.push_back({k, from_corner(c, s, v), made.position.row(index(t.tail(h))).transpose(),
                        made.normal.row(side).transpose(), made.normal.row(side).norm() > 0});
    };
    add(2, 2, a, a);
    add(1, 2, a, a / 2);
    add(2, 3, a / 2, a);
  }
  return limits;
}

}  // namespace sublimit::testing
