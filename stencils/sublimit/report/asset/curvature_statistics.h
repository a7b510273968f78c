// SPDX-License-Identifier: Apache-2.0
#pragma once
// Statistics of the curvature of a limit over its area, from samples in the middle of equal cells of every face.
#include "sublimit/report/asset/asset_report.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit::asset {

/// Properties of a scheme's limits.
struct LimitTraits {
  bool polynomial = true;  ///< by pieces: any place costs little, and has all derivatives
  bool dual = false;       ///< pieces end at halves of faces
  bool thirds = false;     ///< if not by polynomials: at places that halving, or cutting in three, comes to
};

/// @param samples  about so many at most, but one a face; many less of limits that are no polynomials
/// @param tick     called as work is done, with the part of it
AssetCurvature curvature_statistics(const LimitMap& surface, const LimitSurface& bound, std::int64_t samples,
                                    const LimitTraits& traits, const std::function<void(double)>& tick);

/// Places at the same parameters of every square or triangle, in the order of addresses.
struct CellMiddles {
  bool triangles = false;
  int side = 1;                        ///< cells
  double middle = .5, third = 1. / 3;  ///< parameters in squares and in triangles
  std::int64_t per_face() const { return std::int64_t(side) * side; }
  Place operator()(std::int64_t number) const;
};

}  // namespace sublimit::asset
