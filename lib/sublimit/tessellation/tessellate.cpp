// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/tessellate.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/surface/detail/limit_patches.h"
#include "sublimit/tessellation/detail/cell_polygon.h"
#include "sublimit/tessellation/detail/cell_vertices.h"
#include "sublimit/tessellation/detail/flat_cells.h"

namespace sublimit {
namespace {

/// Appends the points between two corners of a side, in order: halves, halves of these, and so on. A point inside of a
/// half is only there where the middle is.
void add_between(const CellVertices& vertices, Index address, const CellCorner& a, const CellCorner& b,
                 std::vector<PolygonCorner>& polygon) {
  if ((a.i + b.i) % 2 != 0 || (a.j + b.j) % 2 != 0) return;
  const CellCorner middle{(a.i + b.i) / 2, (a.j + b.j) / 2};
  const Index vertex = vertices.find(address, middle);
  if (vertex < 0) return;
  add_between(vertices, address, a, middle, polygon);
  polygon.push_back({vertex, middle});
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

}  // namespace

Tessellation tessellate(const LimitMap& surface, const Points& control, const TessellationOptions& options) {
  check(options);
  const LimitMap::Parts& parts = LimitPatches::parts_of(surface);
  const size_t corners = parts.addresses.triangles() ? 3 : 4;
  const std::vector<FlatCell> cells = flat_cells(
      surface, control,
      {.chord = options.chord, .angle = options.angle, .max_triangles = options.max_triangles, .rates = options.rates});
  Tessellation made;
  made.cells = std::ssize(cells);
  CellVertices vertices(parts);
  for (const FlatCell& cell : cells) {
    made.bound = std::max(made.bound, cell.bound);
    for (size_t k = 0; k < corners; ++k) vertices.add(cell.address, cell.corners[k]);
  }
  made.places = vertices.places();
  made.points = surface.evaluate(control, made.places).position;

  std::vector<PolygonCorner> polygon;
  for (const FlatCell& cell : cells) {
    polygon.clear();
    for (size_t k = 0; k < corners; ++k) {
      const CellCorner &a = cell.corners[k], &b = cell.corners[(k + 1) % corners];
      polygon.push_back({vertices.find(cell.address, a), a});
      add_between(vertices, cell.address, a, b, polygon);
    }
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
  made.normals = surface.evaluate(control, corners_of, 1).normal;
  return made;
}

Tessellation LimitSurface::tessellate(const TessellationOptions& options) const {
  return sublimit::tessellate(*this, options);
}

}  // namespace sublimit
