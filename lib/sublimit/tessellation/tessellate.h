// SPDX-License-Identifier: Apache-2.0
#pragma once
// Triangles near a limit surface: by no more than a distance that is proved, not estimated, without cracks, and as few
// as its cells (flat_cells.h) allow. Points are places of the limit: a list of them makes a table that follows a moving
// control mesh (`bake --tessellation`).
//
// Where cells of different sizes meet, in a face or across an edge, the larger one takes the smaller ones' points into
// its sides: there are no T-junctions. Points that faces share are one point, known by connectivity, not by rounding.
#include <array>
#include <cstdint>
#include <vector>

#include "sublimit/limit/limit_surface.h"

namespace sublimit {

struct TessellationOptions {
  /// Largest distance between a point of a triangle and the point of the surface with the same parameters, > 0.
  double chord = 0;
  /// Largest angle between two normals of a cell, in radians; 0: any. Not around extraordinary vertices.
  double angle = 0;
  std::int64_t max_triangles = std::int64_t{1} << 24;
  /// For each edge of the surface's level, >= 1: into how many segments it is cut at least; none: as the chord asks.
  std::vector<Index> rates = {};
};

struct [[nodiscard]] Tessellation {
  struct Triangle {
    Index face = 0;                           ///< square or triangle of the surface, as in `Sample`
    std::array<Index, 3> vertices;            ///< counter-clockwise
    std::array<std::array<double, 2>, 3> uv;  ///< their places in it
  };
  std::vector<Sample> places;  ///< of the vertices; one of them, where several faces have it
  Points points;               ///< #places x 3
  std::vector<Triangle> triangles;
  double bound = 0;  ///< proved for the chord: at most what was asked for, but where cells cannot be cut further
  std::int64_t cells = 0;
};

/// Returns triangles of the whole surface without its holes. The result does not depend on the number of threads.
/// @param control  points of the map's level, #V x 3
/// @throws InvalidParameter     points that do not fit; a chord that is not positive, an angle below 0;
///                              rates as of `tessellate_by_rates`
/// @throws UnsupportedTopology  as `flat_cells`
/// @throws ResourceError        more triangles than allowed: before most of them are made
Tessellation tessellate(const LimitMap& map, const Points& control, const TessellationOptions& options);
/// Returns triangles of a limit surface.
/// @throws as above
inline Tessellation tessellate(const LimitSurface& surface, const TessellationOptions& options) {
  return tessellate(surface.map(), surface.points(), options);
}

}  // namespace sublimit
