// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/tessellate.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/parts/parted_patches.h"
#include "sublimit/parts/shared_sides.h"
#include "sublimit/surface/detail/limit_map_parts.h"
#include "sublimit/tessellation/detail/cell_polygon.h"
#include "sublimit/tessellation/detail/cell_vertices.h"
#include "sublimit/tessellation/detail/edge_rates.h"
#include "sublimit/tessellation/detail/flat_cells.h"

namespace sublimit {
namespace {

/// Appends the points between two corners of a side, in order: halves, halves of these, and so on. A point inside of a
/// half is only there where the middle is. A side that is one point has none.
void add_between(const CellVertices& vertices, Index address, const PolygonCorner& a, const PolygonCorner& b,
                 std::vector<PolygonCorner>& polygon) {
  if ((a.at.i + b.at.i) % 2 != 0 || (a.at.j + b.at.j) % 2 != 0) return;
  const CellCorner at{(a.at.i + b.at.i) / 2, (a.at.j + b.at.j) / 2};
  const PolygonCorner middle{vertices.find(address, at), at};
  if (middle.vertex < 0 || middle.vertex == a.vertex || middle.vertex == b.vertex) return;
  add_between(vertices, address, a, middle, polygon);
  polygon.push_back(middle);
  add_between(vertices, address, middle, b, polygon);
}

void check(const TessellationOptions& options) {
  if (!(options.chord > 0) || !std::isfinite(options.chord))
    throw InvalidParameter("the chord is " + format_number(options.chord) + "; a distance above 0 is right");
  if (!(options.angle >= 0) || !std::isfinite(options.angle))
    throw InvalidParameter("the angle is " + format_number(options.angle) + "; 0 or more is right");
  if (options.max_triangles < 1)
    throw InvalidParameter("at most " + std::to_string(options.max_triangles) + " triangles; 1 or more is right");
}

/// Evaluates places of the surface.
using Evaluate = std::function<LimitSamples(std::span<const Place> places, int order)>;

/// The cells of a surface as triangles.
/// @param vertices  numbers corners of cells
Tessellation triangles_of(const std::vector<FlatCell>& cells, bool triangles, CellVertices vertices,
                          const Evaluate& evaluate, const TessellationOptions& options) {
  const size_t corners = triangles ? 3 : 4;
  Tessellation made;
  made.cells = std::ssize(cells);
  for (const FlatCell& cell : cells) {
    made.bound = std::max(made.bound, cell.bound);
    for (size_t k = 0; k < corners; ++k) vertices.add(cell.address, cell.corners[k]);
  }
  made.places = vertices.places();
  made.points = evaluate(made.places, 0).position;

  std::vector<PolygonCorner> polygon;
  for (const FlatCell& cell : cells) {
    polygon.clear();
    const auto corner = [&](size_t k) {
      const CellCorner& at = cell.corners[k % corners];
      return PolygonCorner{vertices.find(cell.address, at), at};
    };
    for (size_t k = 0; k < corners; ++k) {
      const PolygonCorner a = corner(k), b = corner(k + 1);
      if (a.vertex == b.vertex) continue;  // the side is a point: its end begins the next side
      polygon.push_back(a);
      add_between(vertices, cell.address, a, b, polygon);
    }
    if (polygon.size() < 3) continue;
    triangulate(cell.address, polygon, made);
    if (std::ssize(made.triangles) > options.max_triangles)
      throw ResourceError("more than " + std::to_string(options.max_triangles) +
                          " triangles are needed; allow a larger distance or more triangles");
  }
  if (!options.normals) return made;
  std::vector<Place> corners_of;  // in the faces of their triangles
  corners_of.reserve(3 * made.triangles.size());
  for (const Tessellation::Triangle& triangle : made.triangles)
    for (const auto& [u, v] : triangle.uv) corners_of.push_back({triangle.face, u, v});
  made.normals = evaluate(corners_of, 1).normal;
  return made;
}

FlatCellOptions cell_options(const TessellationOptions& options) {
  return {.chord = options.chord, .angle = options.angle, .max_triangles = options.max_triangles};
}

}  // namespace

Tessellation tessellate(const LimitMap& surface, const Points& control, const TessellationOptions& options) {
  check(options);
  const LimitMap::Parts& parts = surface.parts();
  FlatCellOptions wanted = cell_options(options);
  if (!options.rates.empty()) {
    const Topology& topology = parts.level.topology();
    check_edge_rates(topology, options.rates);
    wanted.longest_sides = [&](Index address) {
      return longest_sides(topology, parts.addresses, options.rates, address);
    };
  }
  return triangles_of(
      flat_cells(surface, control, wanted), parts.addresses.triangles(), CellVertices(parts),
      [&](std::span<const Place> places, int order) { return surface.evaluate(control, places, order); }, options);
}

Tessellation tessellate(const Patches& patches, const TessellationOptions& options) {
  check(options);
  if (!options.rates.empty()) throw InvalidParameter("rates are of the edges of a mesh; patches have none");
  FlatCellOptions wanted = cell_options(options);
  const Points points = points_in_space(patches.points());
  check_above_rounding(points, wanted);
  const PartedPatches surface(patches.set(), patches.points());
  if (const std::string why = surface.without_parts(); !why.empty())
    throw UnsupportedTopology(
        why + ", so that no distance of triangles from it is proved; `sample --grid N` has points of it");
  int degree = 1;
  const FindParts find_parts = [&](Index face, PieceParts& cutter, std::vector<PiecePart>& out) {
    surface.find_parts(face, cutter, out);
  };
  for (Index face = 0; face < surface.faces().size; ++face) degree = std::max(degree, surface.degree(face));
  // Two faces may each be so far from the first one that they share a point with, at corners twice. What is left is for
  // the cells.
  const double diagonal = points.rows() > 0 ? (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm() : 0;
  const double same = std::min(options.chord / 1000, std::max(1e-6 * diagonal, DBL_MIN));
  wanted.chord = options.chord - 4 * same;
  const SharedSides sides(surface.samples(), surface.faces(), {.same = same, .degree = degree});
  // A side that ends where it begins has points between.
  wanted.longest_sides = [&](Index face) {
    std::array<std::int32_t, 4> longest;
    longest.fill(sides.has_loop(face) ? cell_steps / 4 : cell_steps);
    return longest;
  };
  const std::vector<FlatCell> cells = flat_cells(surface.faces(), find_parts, wanted);
  Tessellation made = triangles_of(
      cells, surface.faces().triangles,
      CellVertices([&](Index face, const CellCorner& corner) { return sides.number(face, corner); }),
      [&](std::span<const Place> places, int order) { return patches.evaluate(places, order); }, options);
  made.bound += 2 * sides.gap();
  return made;
}

Tessellation LimitSurface::tessellate(const TessellationOptions& options) const {
  return sublimit::tessellate(*this, options);
}

Tessellation Patches::tessellate(const TessellationOptions& options) const {
  return sublimit::tessellate(*this, options);
}

}  // namespace sublimit
