// SPDX-License-Identifier: Apache-2.0
#pragma once
// Closest points on exact limit surfaces, patches, or whatever a search can take (searched_surface.h). Cells
// (limit_cells.h) are searched from the nearest box on, each by Newton's method, until no box is nearer than the best
// point found, on whatever face. Boxes of polynomial pieces hold them for certain; of schemes without polynomials they
// are of sampled points, widened by a quarter: an estimate.
//
// That no point is nearer is then proved (distance_bound.h). Where the proof finds one, it is taken.
//
// Accuracy: distances to 1e-12 of the surface's size; places, where the point is not on the surface, to the square root
// of that, as the distance hardly changes there. Near centres of curvature, where two feet are close
// together, proofs take longest, and may be cut short. Along borders where a scheme has no derivatives (mid-edge) those
// of the border curve come from differences; near borders of sqrt3, whose derivatives oscillate without end, only the
// border itself is searched well.
//
// Time: a hundred thousand points on a thousand bicubic faces take a second on four cores. Where no piece is a
// polynomial a point takes tens of milliseconds.
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sublimit/limit/limit_surface.h"

namespace sublimit {

class SearchedSurface;

struct [[nodiscard]] ClosestPoints {
  /// Rows of query i are [first[i], first[i + 1]), the nearest first: one each, unless `count` or `radius` was given.
  std::vector<std::int64_t> first;
  std::vector<Sample> places;
  Points points;                    ///< of the surface, #rows x 3
  Points normals;                   ///< there, zero where undefined
  Eigen::VectorXd distances;        ///< from the queries; of signed ones those inside are below 0
  std::vector<LimitStatus> status;  ///< of the places
  /// The surface, less the faces of the rows before, is not nearer than that: proved (distance_bound.h). Within 1e-12
  /// of the surface's size of the distance, and some roundings of the coordinates, unless the search was cut short:
  /// from the centre of a sphere all of it is equally near. 0 where nothing is proved: of schemes without polynomials,
  /// whose hulls are estimates. Never below 0.
  Eigen::VectorXd lower;
};

struct ClosestPointOptions {
  /// A place for each query to start from, or none. Good ones save time; results differ only among equally near points.
  std::span<const Sample> guess = {};
  int most_cells = 2000;  ///< to search for each face of a point, and to look at for its proof
  bool prove = true;      ///< else `lower` stays empty
  int count = 1;          ///< of faces, each with its nearest point; fewer where there are no more
  double radius = std::numeric_limits<double>::infinity();  ///< what is farther is left out, but for rounding
  /// Distances of points inside a closed surface are negative: of those that it winds around (winding.h).
  bool is_signed = false;
};

/// Returns nearest points of a surface, without its holes. The result does not depend on the number of threads.
/// @param queries  #queries x 3
/// @throws InvalidParameter     shapes that do not fit, queries that are not finite or beyond 1e150: says which;
///                              guesses on no face; a count below 1, a radius below 0
/// @throws InvalidMesh          no face that is not a hole
/// @throws UnsupportedTopology  signed distances from a surface that is not closed: says where
ClosestPoints closest(const SearchedSurface& surface, const Points& queries, const ClosestPointOptions& options = {});
/// Returns nearest points of a limit surface.
/// @throws as above
ClosestPoints closest(const LimitSurface& surface, const Points& queries, const ClosestPointOptions& options = {});
/// @param control  points of the map's level, #V x 3
ClosestPoints closest(const LimitMap& surface, const Points& control, const Points& queries,
                      const ClosestPointOptions& options = {});

}  // namespace sublimit
