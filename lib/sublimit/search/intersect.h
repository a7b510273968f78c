// SPDX-License-Identifier: Apache-2.0
#pragma once
// Intersects rays with limit surfaces and patches: all hits of a ray, or the nearest one, none missed.
//
//   const LimitSurface surface(read_mesh("torus.obj"), "catmull-clark");
//   const RayHits hits = intersect(surface, {{.origin = {0, 0, 9}, .direction = {0, 0, -1}}}, {.all = true});
//   for (const double t : hits.t) std::cout << t << "\n";
//   const RayTracer tracer(surface);
//   const std::vector<RayHit> next = tracer.trace({.origin = {9, 0, 0}, .direction = {-1, 0, 0}});
//
// Projected along the ray, a polynomial part is a map to a plane, and hits are its zeros; for a rational part the zeros
// of its numerators. A part whose Bernstein coefficients are all on one side of a line through the ray has none. If
// intervals of its derivatives show that the map is one to one (its Jacobian, times the inverse of one in the middle,
// is near the identity), steps by that inverse converge to the only zero, or to a side of the part beyond which it
// lies. A side that is a single point on the ray, as at poles and apexes, is the only zero of a part that leads away
// from it. Other parts are cut in quarters; those at extraordinary vertices are replaced by their children, until they
// are points. Zeros on a side are computed from every part there and count once.
//
// Pieces without polynomials are sampled by limits on a grid: their extent, and the variation of their Jacobian,
// between the samples is estimated. Steps by exact limits converge to zeros with the same accuracy; that there are no
// others depends on the estimates.
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "sublimit/surface/limit_surface.h"

namespace sublimit {

class Patches;
class PartedSurface;

/// A ray, or a segment of one: the points origin + t direction for tmin <= t <= tmax. The direction need not be unit.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(), direction = Eigen::Vector3d::Zero();
  double tmin = 0, tmax = std::numeric_limits<double>::infinity();
};

/// Kind of a hit.
enum class HitKind : std::uint8_t {
  crossing,  ///< the ray passes from one side of the surface to the other
  /// The ray meets the surface to rounding, but no crossing is seen: it touches the surface, runs within it, or meets
  /// an edge, a vertex, or two sheets at once, with faces seen from both sides.
  touching,
  given_up,  ///< no hit: the search stopped at this t, and hits beyond it may be missing
};
/// Returns the name of a kind in files: `crossing`, `touching`, `given-up`.
const char* name(HitKind kind);

/// Hits of rays, sorted by ray. Plain data.
struct [[nodiscard]] RayHits {
  std::vector<std::int64_t> first;  ///< hits of ray i are [first[i], first[i + 1]), by increasing t
  std::vector<double> t;            ///< parameter of each hit on its ray
  std::vector<HitKind> kinds;       ///< kind of each hit
  std::vector<Place> places;        ///< place of each hit on the surface
  /// Points and normals of the surface, #hits x 3; normals are zero where undefined. If a ray was given up, its point
  /// at this t.
  Points points, normals;
  std::vector<LimitStatus> status;  ///< status of each place; `outside` if the ray was given up
  /// Returns the name of a hit in files: that of its status for crossings, else that of its kind.
  const char* word(std::int64_t hit) const;
  /// Number of hits of each ray that are no crossings. The t of a touching hit has an error of up to the square root of
  /// rounding; a ray within the surface has one such hit, where it enters. A ray is given up at most once.
  std::vector<std::int64_t> undecided;
};

/// Options of `intersect`.
struct RayOptions {
  bool all = false;  ///< all hits, not only the nearest
  /// Largest number of cells to search within one part of the surface that a ray may meet, 1 or more; 64 times as many
  /// within all of them. Cells that depend on many points count as several, by the time that they take. A ray that
  /// needs more is given up there: it has a hit of this kind, besides those elsewhere.
  int most_parts = 8000;
};

/// Returns the hits of rays with any surface that can be searched, without its holes. The result does not depend on the
/// number of threads. No hit of a ray that is not given up is missed if hulls are certain; for schemes without
/// polynomials hulls are estimates, and hits outside them may be missed.
/// @throws InvalidParameter     a ray that is not finite, has no direction, or ends before it begins: says which;
///                              `most_parts` below 1
/// @throws UnsupportedTopology  a face that cannot be searched (`PartedSurface::without_parts`)
RayHits intersect(const PartedSurface& surface, const std::vector<Ray>& rays, const RayOptions& options = {});
/// Returns the hits of rays with a limit surface.
/// @throws as for `PartedSurface`
RayHits intersect(const LimitSurface& surface, const std::vector<Ray>& rays, const RayOptions& options = {});
/// Returns the hits of rays with classical patches.
/// @throws as for `PartedSurface`
RayHits intersect(const Patches& patches, const std::vector<Ray>& rays, const RayOptions& options = {});
/// Returns the hits of rays with a limit map of given control points.
/// @param points  control points of the map's level, #V x 3
/// @throws InvalidParameter  points that do not fit
/// @throws as for `PartedSurface`
RayHits intersect(const LimitMap& surface, const Points& points, const std::vector<Ray>& rays,
                  const RayOptions& options = {});

/// A hit of one ray.
struct RayHit {
  double t = 0;  ///< parameter on the ray
  Place place;
  HitKind kind = HitKind::crossing;
};

/// A surface prepared for tracing single rays, once for each set of control points. Any number of threads may trace at
/// a time. A renderer with a tree of its own may select the face to search.
class RayTracer {
 public:
  /// Prepares any surface that can be searched.
  /// @param surface  may be destroyed afterwards; the map and points that a `PartedLimit` refers to must stay
  /// @throws UnsupportedTopology  as `intersect`
  explicit RayTracer(const PartedSurface& surface);
  /// Prepares a limit surface.
  explicit RayTracer(const LimitSurface& surface);
  /// Prepares a limit map with given control points.
  /// @param points  control points of the map's level, #V x 3
  /// @throws InvalidParameter  points that do not fit
  RayTracer(const LimitMap& map, const Points& points) : RayTracer(LimitSurface(map, points)) {}
  // Copies share what was prepared. Moving copies: a moved-from object stays valid.
  RayTracer(const RayTracer&) = default;
  RayTracer& operator=(const RayTracer&) = default;

  /// Returns the hits of a ray as `intersect` does, by increasing t. Places are less accurate than t at extraordinary
  /// vertices, and inaccurate next to the borders of dual schemes.
  /// @param address    face to search, if given; a hit on an edge belongs to each of its faces
  /// @param undecided  gets the number of hits that are no crossings, if not null
  /// @throws InvalidParameter  as `intersect`; a face that the surface does not have
  std::vector<RayHit> trace(const Ray& ray, const RayOptions& options = {}, std::optional<Index> address = {},
                            std::int64_t* undecided = nullptr) const;

 private:
  struct Prepared;
  std::shared_ptr<Prepared> prepared_;
};

}  // namespace sublimit
