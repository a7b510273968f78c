// SPDX-License-Identifier: Apache-2.0
#pragma once
// How much a limit bends: statistics over its area, by samples in the middle of equal cells of every face.
#include "sublimit/limit/limit_surface.h"
#include "sublimit/report/asset_report.h"

namespace sublimit::asset {

/// @param samples  about so many at most, but one a face
/// @param thirds   the scheme cuts in three: derivatives are known there, else at halves
/// @param dual    of a dual scheme
/// @param tick     called as work is done, with the part of it
AssetCurvature curvature_statistics(const LimitSurface& surface, const BoundLimitSurface& bound, std::int64_t samples,
                                    bool thirds, bool dual, const std::function<void(double)>& tick);

/// The same places on every square or triangle, counted from the first address on.
struct CellMiddles {
  bool triangles = false, thirds = false;
  bool beside = false;  ///< a little, of the exact middle: off the seams of dual schemes, which have halves
  int side = 1;         ///< cells
  std::int64_t per_face() const { return std::int64_t(side) * side; }
  Sample operator()(std::int64_t number) const;
};

}  // namespace sublimit::asset
