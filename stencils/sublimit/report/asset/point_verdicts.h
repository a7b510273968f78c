// SPDX-License-Identifier: Apache-2.0
#pragma once
// The behaviour of a scheme at a point of some type that is isolated among regular points: existence of a tangent
// plane, and of curvature. Computed from the local matrix of the masks, in floating point.
#include <map>
#include <tuple>

#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/report/asset/asset_report.h"

namespace sublimit::asset {

class PointVerdicts {
 public:
  explicit PointVerdicts(const Scheme<double>& scheme) : cache_(scheme) {}
  /// Returns the verdict on an interior vertex with n faces.
  const PointVerdict& inside(Index n) { return of({Centre::Kind::vertex, n, false, false, 0}); }
  /// Returns the verdict on the middle of a face with n corners.
  const PointVerdict& face(Index n) { return of({Centre::Kind::face, n, false, false, 0}); }
  /// Returns the verdict on one side of a border, a crease or a corner, with n faces.
  const PointVerdict& side(Index n, bool corner) { return of({Centre::Kind::vertex, n, true, corner, 0}); }
  /// Returns the verdict on the end of a single sharp edge among n faces.
  const PointVerdict& dart(Index n);

 private:
  const PointVerdict& of(const LocalType& type);
  LimitCache cache_;
  std::map<LocalType, PointVerdict> known_;
  std::map<Index, PointVerdict> darts_;
};

/// Most faces at a point whose curvature, and whose seams of patches, are analysed. The cost of their matrices
/// grows with the square of n.
inline constexpr Index most_faces = 40;

}  // namespace sublimit::asset
