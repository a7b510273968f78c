// SPDX-License-Identifier: Apache-2.0
#pragma once
// Statistics of the curvature of a limit over its area, from samples in the middle of equal cells of every face.
#include "sublimit/report/asset/asset_report.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit::asset {

/// Properties of a scheme's limits.
struct LimitTraits {
  bool polynomial = true;  ///< piecewise polynomial: places are cheap, and have all derivatives
  bool dual = false;       ///< pieces end in the middle of faces
  bool thirds = false;     ///< without polynomials: evaluated at thirds, otherwise at halves
};

/// Returns the statistics of curvature.
/// @param samples  about the most samples, but at least one per face; a fiftieth of it without polynomials
/// @param tick     if given, called with the fraction of the work done
AssetCurvature curvature_statistics(const LimitMap& surface, const LimitSurface& bound, std::int64_t samples,
                                    const LimitTraits& traits, const std::function<void(double)>& tick);

/// Places at the same parameters of every square or triangle, in the order of addresses.
struct CellMiddles {
  bool triangles = false;
  int side = 1;                        ///< cells on each side of a face
  double middle = .5, third = 1. / 3;  ///< parameters of samples in cells that are squares or triangles
  std::int64_t per_face() const { return std::int64_t(side) * side; }
  Place operator()(std::int64_t number) const;
};

}  // namespace sublimit::asset
