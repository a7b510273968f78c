// SPDX-License-Identifier: Apache-2.0
#pragma once
// Proved lower bounds of the distance of a point from a surface, by branch and bound on its parts.
//
// The distance of a polynomial or rational part is at least that of its box, and at least min (b - q) n over its
// Bernstein coefficients b for any unit vector n. If intervals of their differences show that |x - q|^2 is
// convex on the part, the tangent plane of its graph at the minimum is below it, so that the minimum itself is
// a bound up to rounding. Other parts, near extraordinary vertices, lie in the convex hull of the points that
// they depend on, and are replaced by their children.
#include <optional>
#include <span>

#include "sublimit/parts/parted_surface.h"
#include "sublimit/search/detail/surface_parts.h"

namespace sublimit {

/// Result of a proof.
struct [[nodiscard]] ProvedDistance {
  double lower = 0;             ///< no point of the surface is nearer; 0: nothing is proved
  std::optional<Place> closer;  ///< a place nearer than the given distance; `lower` is the bound when it was found
};

/// Lower bounds for a surface.
class DistanceBound {
 public:
  /// @param surface  needed during construction only; the map or patches that it refers to must outlive this
  explicit DistanceBound(const PartedSurface& surface) : parts_(surface) {}

  /// Returns a bound for a point. Threads may call it at the same time.
  /// @param distance  distance of the nearest known point
  /// @param most      largest number of parts to examine; the rest is bounded by boxes
  /// @param cutter    belongs to the calling thread
  /// @param without   faces (of `Place`) to ignore
  /// @note  Nothing is proved if hulls are estimates, as for schemes without polynomials, or faces have no
  ///        parts.
  ProvedDistance operator()(const Eigen::Vector3d& query, double distance, int most, PieceParts& cutter,
                            std::span<const Index> without = {}) const;

 private:
  SurfaceParts parts_;
};

}  // namespace sublimit
