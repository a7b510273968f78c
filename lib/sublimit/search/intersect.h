// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where rays meet a surface: all places, or the nearest one, none missed.
//
// Seen along the ray a polynomial part is a map to the plane across it, and hits are its zeros, of a rational part
// those of its numerators. A part whose Bernstein coefficients are all on one side of a line through the ray has none.
// Where intervals of its derivatives show that the map is one to one (its Jacobian, times the inverse of one in the
// middle, is near the identity), steps by that inverse come to the one zero, or to a side that it is beyond. A side
// that is a point on the ray, as poles and apexes are, is the one zero of a part that leads away from it. Other parts
// are cut in quarters; those towards extraordinary vertices are replaced by their children, until they are points.
// Zeros on a side are found from every part there and count once.
//
// Pieces without polynomials are seen as limits on a grid: how far they go, and how much their Jacobian varies, between
// these is estimated. Steps by exact limits lead to zeros, as near as elsewhere; that there are no others rests on the
// estimates.
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "sublimit/limit/limit_surface.h"

namespace sublimit {

class SearchedSurface;

struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(), direction = Eigen::Vector3d::Zero();
  double tmin = 0, tmax = std::numeric_limits<double>::infinity();  ///< of origin + t direction
};

/// Kind of a hit.
enum class HitKind : std::uint8_t {
  crossing,  ///< it goes from one side of the surface to the other
  /// It is as near as numbers go without being seen to cross: it touches the surface or runs within it, or meets an
  /// edge or a vertex, or two sheets at once, that it sees from both sides.
  touching,
  given_up,  ///< no hit: the search stopped here, and what the ray meets from this t on may not be all
};
/// `crossing`, `touching`, `given-up`.
const char* name(HitKind kind);

struct [[nodiscard]] RayHits {
  std::vector<std::int64_t> first;  ///< hits of ray i are [first[i], first[i + 1]), by rising t
  std::vector<double> t;
  std::vector<HitKind> kinds;
  std::vector<Sample> places;
  /// Points and normals of the surface, #hits x 3; normals are zero where undefined. If a ray was given up: its point.
  Points points, normals;
  std::vector<LimitStatus> status;  ///< `outside` where a ray was given up
  /// The word of a hit, as files have it: of its kind, or of its status where the ray crosses.
  const char* word(std::int64_t hit) const;
  /// How many hits of a ray are no crossings. A touching hit has a t that is off by up to the root of a rounding; a ray
  /// within the surface has one, where it comes to it. At most one of a ray is given up, the first one.
  std::vector<std::int64_t> undecided;  ///< by ray
};

struct RayOptions {
  bool all = false;  ///< all hits, not only the nearest
  /// To look at within one part of the surface that a ray may meet, and 64 times as many of all of them, 1 or more.
  /// Those that depend on many points count as several, by the time that they take. A ray that needs more is given up
  /// there: it has a hit that says so, and those found elsewhere.
  int most_parts = 8000;
};

/// Holes left out. Equal input, equal answer, whatever the number of threads. Where a ray is not given up, no hit is
/// missed, but where hulls are estimates (`SurfaceParts::are_certain`), as of schemes without polynomials: there every
/// hit is one, and one may be missed that the estimates do not hold.
/// @throws InvalidParameter     a ray that is not finite, has no direction, or ends before it begins: says which; no
/// parts
///                              to look at
/// @throws UnsupportedTopology  a face that has no parts (`SearchedSurface::without_parts`)
RayHits intersect(const SearchedSurface& surface, const std::vector<Ray>& rays, const RayOptions& options = {});
/// Returns where rays meet a limit surface.
/// @throws as above
RayHits intersect(const LimitSurface& surface, const std::vector<Ray>& rays, const RayOptions& options = {});
/// @param points  of the map's level, #V x 3
/// @throws InvalidParameter  points that do not fit
RayHits intersect(const LimitMap& surface, const Points& points, const std::vector<Ray>& rays,
                  const RayOptions& options = {});

struct RayHit {
  double t = 0;
  Sample place;
  HitKind kind = HitKind::crossing;
};

/// A surface prepared for single rays, as renderers trace them: a renderer's own tree may select the address. Made once
/// for each pose. Any number of threads may trace at a time.
class RayTracer {
 public:
  /// @param surface  which may go; what a `SearchedLimit` is of has to stay
  /// @throws UnsupportedTopology  as `intersect`
  explicit RayTracer(const SearchedSurface& surface);
  explicit RayTracer(const LimitSurface& surface);
  /// @param points  of the map's level, #V x 3
  /// @throws InvalidParameter  points that do not fit
  RayTracer(const LimitMap& map, const Points& points) : RayTracer(LimitSurface(map, points)) {}
  // Copies share what was prepared. Moving copies: a moved-from object stays valid.
  RayTracer(const RayTracer&) = default;
  RayTracer& operator=(const RayTracer&) = default;

  /// Returns the hits that `intersect` finds, by rising t. Places are less accurate than t at extraordinary vertices,
  /// and may be off next to the borders of dual schemes.
  /// @param address    only the part of the surface there; of an edge each of its addresses has the hit
  /// @param undecided  as `RayHits::undecided` counts, if not null
  /// @throws InvalidParameter  as `intersect`; an address that the surface does not have
  std::vector<RayHit> trace(const Ray& ray, const RayOptions& options = {}, std::optional<Index> address = {},
                            std::int64_t* undecided = nullptr) const;

 private:
  struct Prepared;
  std::shared_ptr<Prepared> prepared_;
};

}  // namespace sublimit
