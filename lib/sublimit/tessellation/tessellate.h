// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tessellates surfaces: triangles within a proved distance of a limit surface or of classical patches.
//
//   const LimitSurface surface(read_mesh("torus.obj"), "catmull-clark");
//   const Tessellation flat = tessellate(surface, {.chord = 1e-3});
//   for (const Tessellation::Triangle& t : flat.triangles) std::cout << flat.points.row(t.vertices[0]) << "\n";
//   const Points moved = place_stencils(surface.map(), flat.places).matrices[0] * surface.points();
//
// Points are places of the limit, so that the stencils of `places` move the triangles with the control mesh. Where
// cells of different sizes meet, in a face or across an edge, the larger one takes the smaller ones' points into its
// sides: there are no T-junctions. Points that faces share are one point, by connectivity, not by rounding. Patches
// know nothing of each other: their sides are one where they are the same curve in the same parameter.
#include <array>
#include <cstdint>
#include <vector>

#include "sublimit/patches/patches.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit {

/// Options of `tessellate`.
struct TessellationOptions {
  /// Largest distance between a point of a triangle and the point of the surface with the same parameters, > 0.
  double chord = 0;
  /// Largest angle between two normals of a cell, in radians; 0: any. It is not enforced around extraordinary vertices,
  /// nor in cells at a pole that are smaller than the chord: normals turn there however small a cell is.
  double angle = 0;
  std::int64_t max_triangles = std::int64_t{1} << 24;  ///< limit of the number of triangles
  /// Least number of segments for each edge of the surface's level, >= 1; empty: as many as the chord needs. Patches
  /// have none.
  std::vector<Index> rates = {};
  bool normals = false;  ///< compute normals at the corners of triangles
};

/// Triangles near a surface. Plain data.
struct [[nodiscard]] Tessellation {
  struct Triangle {
    Index face = 0;                           ///< square or triangle of the surface, as in `Place`
    std::array<Index, 3> vertices;            ///< rows of `points`, counter-clockwise
    std::array<std::array<double, 2>, 3> uv;  ///< parameters of the vertices in `face`
  };
  std::vector<Place> places;  ///< place of each vertex, on one of the faces that share it
  Points points;              ///< #places x 3
  std::vector<Triangle> triangles;
  /// If asked for: normal of corner k of triangle t in row 3 t + k, on that triangle's side of sharp edges.
  Points normals;
  double bound = 0;        ///< proved bound of the distance; above `chord` only if cells could not be cut further
  std::int64_t cells = 0;  ///< number of cells that were triangulated
};

/// Returns triangles of the whole surface without its holes. The result does not depend on the number of threads.
/// @param control  control points of the map's level, #V x 3
/// @throws InvalidParameter     points that do not fit; a chord or angle that is negative or below rounding; rates
///                              that are not one for each edge, or below 1
/// @throws UnsupportedTopology  a scheme whose distances to triangles cannot be proved (without polynomial pieces, or
///                              with negative weights at extraordinary vertices)
/// @throws ResourceError        more triangles than allowed: thrown before most of them are made
Tessellation tessellate(const LimitMap& map, const Points& control, const TessellationOptions& options);
/// Returns triangles of a limit surface.
/// @throws as for a map
inline Tessellation tessellate(const LimitSurface& surface, const TessellationOptions& options) {
  return tessellate(surface.map(), surface.points(), options);
}

/// Returns triangles of classical patches. Sides of patches are joined if they are the same curve in the same
/// parameter, up to a thousandth of the chord or a millionth of the diagonal, and poles are single points; elsewhere
/// patches stay apart, so that a side that lies on a part of another one leaves a crack of up to twice the chord.
/// Triangles have the orientation of their patches, which may look to different sides (`why_no_solid` of
/// `limit_integrals` tells).
/// @throws InvalidParameter     a chord or angle that is negative or below rounding; rates
/// @throws UnsupportedTopology  a face that is no polynomial and no quotient of polynomials, or one with a denominator
///                              that vanishes: names it
/// @throws ResourceError        more triangles than allowed: thrown before most of them are made
Tessellation tessellate(const Patches& patches, const TessellationOptions& options);

}  // namespace sublimit
