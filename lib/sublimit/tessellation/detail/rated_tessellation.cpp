// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/detail/rated_tessellation.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/surface/detail/limit_map_parts.h"
#include "sublimit/tessellation/detail/cell_polygon.h"
#include "sublimit/tessellation/detail/cell_vertices.h"
#include "sublimit/tessellation/detail/edge_rates.h"

namespace sublimit {
namespace {

/// Where k of n parts end, in steps: seen from the other end it is the same place.
std::int32_t part(std::int64_t k, std::int64_t n) {
  return static_cast<std::int32_t>((2 * k * cell_steps + n) / (2 * n));
}

/// A side of a square or triangle, or half an edge as a side of a square of a polygon.
struct Side {
  Index segments = 1;
  SideEdge::Of of = SideEdge::Of::whole;
  std::int32_t at(Index k) const {
    if (of == SideEdge::Of::first_half) return 2 * part(k, 2 * std::int64_t{segments});
    if (of == SideEdge::Of::second_half) return cell_steps - 2 * part(segments - k, 2 * std::int64_t{segments});
    return part(k, segments);
  }
};

/// Sides of an address, counter-clockwise from (0, 0).
using Sides = std::array<Side, 4>;

CellCorner on_side(size_t side, std::int32_t t, bool triangle) {
  if (side == 0) return {t, 0};
  if (side == 1) return {triangle ? cell_steps - t : cell_steps, t};
  if (side == 2 && !triangle) return {cell_steps - t, cell_steps};
  return {0, cell_steps - t};
}

/// A place in a side's chain: the parameter along the side too.
struct ChainPoint {
  PolygonCorner corner;
  double t = 0;
};
using Chain = std::vector<ChainPoint>;

class RatedFaces {
 public:
  RatedFaces(const LimitMap::Parts& parts, std::span<const Index> rates)
      : t_(parts.level.topology()), addresses_(parts.addresses), rates_(rates), triangle_(addresses_.triangles()) {}

  Sides sides(Index address) const {
    const std::array<SideEdge, 4> edges = side_edges(t_, addresses_, address);
    Sides sides;
    for (size_t k = 0; k < (triangle_ ? 3 : 4); ++k) {
      const auto [of, edge] = edges[k];
      sides[k] = {of == SideEdge::Of::none    ? between_squares(addresses_.place(address).face)
                  : of == SideEdge::Of::whole ? rate(edge)
                                              : rate(edge) / 2,
                  of};
    }
    return sides;
  }
  /// Segments of the grid inside, along u and v.
  std::array<Index, 2> grid(const Sides& sides) const {
    if (triangle_) {
      const Index n = std::max({sides[0].segments, sides[1].segments, sides[2].segments});
      return {n, n};
    }
    return {std::max(sides[0].segments, sides[2].segments), std::max(sides[1].segments, sides[3].segments)};
  }
  /// Between the squares of a polygon: what the largest of its edges has.
  Index between_squares(Face face) const {
    Index most = 1;
    for (Index k = 0; k < t_.size(face); ++k) most = std::max(most, rate(t_.edge(t_.corner(face, k))) / 2);
    return most;
  }
  bool has_inside(const std::array<Index, 2>& n) const { return triangle_ ? n[0] >= 3 : n[0] >= 2 && n[1] >= 2; }

 private:
  Index rate(Edge e) const {
    const Index given = rates_[size_t(index(e))];
    if (triangle_ || given % 2 == 0) return given;
    for (const HalfEdge h : t_.half_edges(e))
      if (t_.size(t_.face(h)) != 4) return given + 1;
    return given;
  }
  const Topology& t_;
  const Addresses& addresses_;
  std::span<const Index> rates_;
  bool triangle_;
};

/// Makes the points of an address, then its triangles; both walk through it in the same order.
class FaceGrid {
 public:
  FaceGrid(Index address, const Sides& sides, const std::array<Index, 2>& n, bool inside, bool triangle)
      : address_(address), sides_(sides), n_(n), inside_(inside), triangle_(triangle) {}

  void add_points(CellVertices& vertices) const {
    for (size_t s = 0; s < corners(); ++s)
      for (Index k = 0; k < sides_[s].segments; ++k) vertices.add(address_, on_side(s, sides_[s].at(k), triangle_));
    if (!inside_) return;
    for (Index i = 1; i < n_[0]; ++i)
      for (Index j = 1; j < (triangle_ ? n_[0] - i : n_[1]); ++j) vertices.add(address_, inner(i, j));
  }

  void add_triangles(const CellVertices& vertices, Tessellation& made) const {
    const auto corner = [&](const CellCorner& c) { return PolygonCorner{vertices.find(address_, c), c}; };
    if (!inside_) {
      std::vector<PolygonCorner> polygon;
      for (size_t s = 0; s < corners(); ++s)
        for (Index k = 0; k < sides_[s].segments; ++k)
          polygon.push_back(corner(on_side(s, sides_[s].at(k), triangle_)));
      return triangulate(address_, polygon, made);
    }
    for (size_t s = 0; s < corners(); ++s) {
      Chain outer, inside;
      for (Index k = 0; k <= sides_[s].segments; ++k)
        outer.push_back({corner(on_side(s, sides_[s].at(k), triangle_)), double(k) / sides_[s].segments});
      const Index n = n_[triangle_ ? 0 : s % 2];
      for (Index k = 1; k < (triangle_ ? n - 1 : n); ++k)
        inside.push_back({corner(along(s, k)), (triangle_ ? k + 0.5 : k) / n});
      zip(outer, inside, made);
    }
    const auto at = [&](Index i, Index j) { return corner(inner(i, j)); };
    if (triangle_) {
      for (Index i = 1; i < n_[0]; ++i)
        for (Index j = 1; i + j + 1 < n_[0]; ++j) {
          add_triangle(address_, at(i, j), at(i + 1, j), at(i, j + 1), made);
          if (i + j + 2 < n_[0]) add_triangle(address_, at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), made);
        }
      return;
    }
    for (Index j = 1; j + 1 < n_[1]; ++j)
      for (Index i = 1; i + 1 < n_[0]; ++i) {
        std::vector<PolygonCorner> square{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        triangulate(address_, square, made);
      }
  }

 private:
  size_t corners() const { return triangle_ ? 3 : 4; }
  CellCorner inner(Index i, Index j) const { return {part(i, n_[0]), part(j, n_[1])}; }
  /// Place k of the grid's points next to a side.
  CellCorner along(size_t s, Index k) const {
    if (s == 0) return inner(k, 1);
    if (triangle_) return s == 1 ? inner(n_[0] - 1 - k, k) : inner(1, n_[0] - 1 - k);
    if (s == 1) return inner(n_[0] - 1, k);
    return s == 2 ? inner(n_[0] - k, n_[1] - 1) : inner(1, n_[1] - k);
  }
  /// Triangles between two chains that go the same way, the second one on the left.
  void zip(const Chain& outer, const Chain& inside, Tessellation& made) const {
    size_t o = 0, i = 0;
    while (o + 1 < outer.size() || i + 1 < inside.size()) {
      const bool along_outer = i + 1 == inside.size() || (o + 1 < outer.size() && outer[o + 1].t <= inside[i + 1].t);
      if (along_outer) {
        add_triangle(address_, outer[o].corner, outer[o + 1].corner, inside[i].corner, made);
        ++o;
      } else {
        add_triangle(address_, outer[o].corner, inside[i + 1].corner, inside[i].corner, made);
        ++i;
      }
    }
  }

  Index address_;
  const Sides& sides_;
  std::array<Index, 2> n_;
  bool inside_, triangle_;
};

}  // namespace

Tessellation tessellate_by_rates(const LimitMap& surface, const Points& control, std::span<const Index> rates,
                                 std::int64_t max_triangles) {
  const LimitMap::Parts& parts = surface.parts();
  check_edge_rates(parts.level.topology(), rates);
  const AddressPieces pieces(surface, control);
  const RatedFaces faces(parts, rates);
  const bool triangle = parts.addresses.triangles();
  std::vector<Index> addresses;
  std::int64_t count = 0;
  for (Index a = 0; a < parts.addresses.size(); ++a) {
    bool exists = false;
    pieces.visit(a, [&](const PieceType&, const Points&, const CellCorners&) { exists = true; });
    if (!exists) continue;
    addresses.push_back(a);
    const std::array<Index, 2> n = faces.grid(faces.sides(a));
    if (faces.has_inside(n)) count += (triangle ? 1 : 2) * std::int64_t{n[0] - 2} * (n[1] - 2);
    if (count > max_triangles)
      throw ResourceError("more than " + std::to_string(max_triangles) +
                          " triangles are asked for; allow more triangles, or lower the rates");
  }
  CellVertices vertices(parts);
  const auto visit = [&](const auto& what) {
    for (const Index a : addresses) {
      const Sides sides = faces.sides(a);
      const std::array<Index, 2> n = faces.grid(sides);
      what(FaceGrid(a, sides, n, faces.has_inside(n), triangle));
    }
  };
  visit([&](const FaceGrid& face) { face.add_points(vertices); });
  Tessellation made;
  made.cells = std::ssize(addresses);
  made.places = vertices.places();
  made.points = surface.evaluate(control, made.places).position;
  visit([&](const FaceGrid& face) { face.add_triangles(vertices, made); });
  return made;
}

}  // namespace sublimit
