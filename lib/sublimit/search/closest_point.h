// SPDX-License-Identifier: Apache-2.0
#pragma once
// Closest points on exact limit surfaces and patches, with a proof that no point is nearer.
//
//   const LimitSurface surface(read_mesh("torus.obj"), "catmull-clark");
//   const ClosestPoints near = closest(surface, Points{{2, 0, 0}, {0, 1, 3}});
//   near.points.row(0), near.distances[0], near.places[0];
//   const ClosestPoints within = closest(surface, Points{{2, 0, 0}}, {.nearest = 8, .radius = 0.5});
//
// Cells of the surface are searched in the order of their boxes' distances, each by Newton's method, until no box is
// nearer than the best point. Boxes of polynomial pieces certainly contain them; those of schemes without polynomials
// contain sampled points and are widened by a quarter: an estimate. A bound of the distance is then proved; if the
// proof meets a nearer point, that is taken.
//
// Accuracy: distances to 1e-12 of the surface's size; places of points off the surface to the square root of that, as
// the distance hardly changes there. Near centres of curvature, where two foot points are close together, proofs take
// longest, and may be cut short. Along borders where a scheme has no derivatives (mid-edge) those of the border curve
// are differences; near borders of sqrt3, whose derivatives oscillate on every level, only the border itself is
// searched well.
//
// Time: a hundred thousand points on a thousand bicubic faces take a second on four cores. Without polynomial pieces a
// point takes tens of milliseconds.
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sublimit/surface/limit_surface.h"

namespace sublimit {

class Patches;
class PartedSurface;

/// Nearest points, in rows. Plain data.
struct [[nodiscard]] ClosestPoints {
  /// Rows of query i are [first[i], first[i + 1]), the nearest first: one each, unless `nearest` or `radius` was given.
  std::vector<std::int64_t> first;
  std::vector<Place> places;        ///< place of each point
  Points points;                    ///< points of the surface, #rows x 3
  Points normals;                   ///< normals there, zero where undefined
  Eigen::VectorXd distances;        ///< distances from the queries; if signed, negative inside
  std::vector<LimitStatus> status;  ///< status of each place
  /// Proved lower bounds of the distance of the surface without the faces of the query's rows before. A bound is within
  /// 1e-12 of the surface's size, and some roundings of the coordinates, of the distance, unless the search was cut
  /// short, as from the centre of a sphere. 0 if nothing is proved, as for schemes without polynomials, whose hulls are
  /// estimates. Never below 0.
  Eigen::VectorXd lower;
};

/// Options of `closest`.
struct ClosestPointOptions {
  /// A place for each query to start from, or none. Good ones save time; results differ only among equally near points.
  std::span<const Place> guess = {};
  int most_cells = 2000;  ///< largest number of cells to search for each face of a point, and to use in its proof
  bool prove = true;      ///< compute `lower`, which is empty otherwise
  int nearest = 1;        ///< number of nearest faces, each with its nearest point; fewer if there are no more
  double radius = std::numeric_limits<double>::infinity();  ///< points farther away are left out, up to rounding
  /// Give points inside a closed surface, those with a winding number that is not 0, negative distances.
  bool is_signed = false;
};

/// Returns nearest points of any surface that can be searched, without its holes. The result does not depend on the
/// number of threads.
/// @param queries  #queries x 3
/// @throws InvalidParameter     shapes that do not fit, queries that are not finite or beyond 1e150: says which;
///                              guesses on no face; `nearest` below 1, a radius below 0
/// @throws InvalidMesh          no face that is not a hole
/// @throws UnsupportedTopology  signed distances from a surface that is not closed: says where
ClosestPoints closest(const PartedSurface& surface, const Points& queries, const ClosestPointOptions& options = {});
/// Returns nearest points of a limit surface.
/// @param points  the queries, #queries x 3
/// @throws as for `PartedSurface`
ClosestPoints closest(const LimitSurface& surface, const Points& points, const ClosestPointOptions& options = {});
/// Returns nearest points of classical patches.
/// @param points  the queries, #queries x 3
/// @throws as for `PartedSurface`
ClosestPoints closest(const Patches& patches, const Points& points, const ClosestPointOptions& options = {});
/// Returns nearest points of a limit map with given control points.
/// @param control  control points of the map's level, #V x 3
/// @param queries  #queries x 3
/// @throws InvalidParameter  control points that do not fit
/// @throws as for `PartedSurface`
ClosestPoints closest(const LimitMap& surface, const Points& control, const Points& queries,
                      const ClosestPointOptions& options = {});

}  // namespace sublimit
