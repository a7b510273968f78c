// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where rays meet a surface: all places, or the nearest one, none missed.
//
// Seen along the ray a polynomial part is a map to the plane across it, and hits are its zeros, of a rational part
// those of its numerators. A part whose Bernstein coefficients are all on one side of a line through the ray has none.
// Where intervals of its derivatives show that the map is one to one (its Jacobian, times the inverse of one in the
// middle, is near the identity), steps by that inverse come to the one zero, or to a side that it is beyond. Other
// parts are cut in quarters; those towards extraordinary vertices are replaced by their children, until they are
// points. Zeros on a side are found from every part there and count once.
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "sublimit/search/searched_surface.h"

namespace sublimit {

struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(), direction = Eigen::Vector3d::Zero();
  double tmin = 0, tmax = std::numeric_limits<double>::infinity();  ///< of origin + t direction
};

struct [[nodiscard]] RayHits {
  std::vector<std::int64_t> first;  ///< hits of ray i are [first[i], first[i + 1]), by rising t
  std::vector<double> t;
  std::vector<Sample> places;
  Points points, normals;  ///< of the surface there, #hits x 3; normals zero where undefined
  std::vector<LimitStatus> status;
  /// Not decided: parts that a ray touches, or extraordinary vertices that it meets, which were cut to points: together
  /// they count as one hit, whose t is off by up to the root of a rounding; and parts that were left after
  /// `RayOptions::most_parts`, which do not count. A ray within the surface has one hit, where it comes to it.
  std::vector<std::int64_t> undecided;  ///< how many, by ray
};

struct RayOptions {
  bool all = false;        ///< all hits, not only the nearest
  int most_parts = 20000;  ///< to look at for one ray
};

/// Holes left out. Equal input, equal answer, whatever the number of threads. Where hulls are estimates
/// (`SurfaceParts::are_certain`), as of schemes without polynomials, a hit may be missed that they do not hold.
/// @throws InvalidParameter     a ray that is not finite, has no direction, or ends before it begins: says which
/// @throws UnsupportedTopology  a face that has no parts (`SearchedSurface::without_parts`)
RayHits intersect(const SearchedSurface& surface, const std::vector<Ray>& rays, const RayOptions& options = {});
/// @param points  of the surface's level, #V x 3
/// @throws InvalidParameter  points that do not fit
RayHits intersect(const LimitSurface& surface, const Points& points, const std::vector<Ray>& rays,
                  const RayOptions& options = {});

struct RayHit {
  double t = 0;
  Sample place;
};

/// A surface made ready for single rays, as a renderer traces them, whose own tree may say which addresses a ray can
/// meet. Made once for each pose; any number of threads may trace at a time, and each keeps memory of its own here.
class RayTracer {
 public:
  /// @param surface  which may go; what a `SearchedLimit` is of has to stay
  /// @throws UnsupportedTopology  as `intersect`
  explicit RayTracer(const SearchedSurface& surface);
  /// @param surface  which must stay
  /// @param points   of its level, #V x 3
  /// @throws InvalidParameter  points that do not fit
  RayTracer(const LimitSurface& surface, const Points& points);
  RayTracer(const LimitSurface&&, const Points&) = delete;
  RayTracer(RayTracer&&) noexcept;
  RayTracer& operator=(RayTracer&&) noexcept;
  ~RayTracer();

  /// The hits that `intersect` finds, by rising t. The place is that of the part which is hit: at extraordinary
  /// vertices it has fewer digits than t, and next to the borders of dual schemes it may be off.
  /// @param address    only the part of the surface there; of an edge each of its addresses has the hit
  /// @param undecided  as `RayHits::undecided` counts, if not null
  /// @throws InvalidParameter  as `intersect`; an address that the surface does not have
  std::vector<RayHit> trace(const Ray& ray, const RayOptions& options = {}, std::optional<Index> address = {},
                            std::int64_t* undecided = nullptr) const;

 private:
  struct Prepared;
  std::unique_ptr<Prepared> prepared_;
};

}  // namespace sublimit
