// SPDX-License-Identifier: Apache-2.0
#pragma once
// How near a surface is to a point at least: proved, by branch and bound on its parts.
//
// The distance of a polynomial or rational part is at least that of its box, and at least min (b - q) n over its
// Bernstein coefficients b for any unit vector n. Where intervals of their differences show that |x - q|^2 is convex on
// the part, the tangent plane of its graph at the minimum is below it, so that the minimum itself is the bound, but for
// rounding. Other parts, towards extraordinary vertices, are in the hull of the points that they depend on, and are
// replaced by their children.
#include <optional>
#include <span>

#include "sublimit/search/detail/searched_surface.h"
#include "sublimit/search/detail/surface_parts.h"

namespace sublimit {

struct [[nodiscard]] ProvedDistance {
  double lower = 0;             ///< no point of the surface is nearer; 0: nothing is proved
  std::optional<Place> closer;  ///< a place that is nearer than was said; `lower` is what had been proved by then
};

class DistanceBound {
 public:
  /// @param surface  which may go; what a `SearchedLimit` is of has to stay
  explicit DistanceBound(const SearchedSurface& surface) : parts_(surface) {}

  /// @param distance  of the nearest point that is known
  /// @param most      parts to look at; what is left then counts with its box
  /// @param cutter    of the calling thread
  /// @param without   faces (of `Place`) that do not count
  /// @note  Any thread may ask. Where hulls are estimates, as of schemes without polynomials, or faces have no
  ///        parts, nothing is proved.
  ProvedDistance operator()(const Eigen::Vector3d& query, double distance, int most, PieceParts& cutter,
                            std::span<const Index> without = {}) const;

 private:
  SurfaceParts parts_;
};

}  // namespace sublimit
