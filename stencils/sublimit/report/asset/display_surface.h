// SPDX-License-Identifier: Apache-2.0
#pragma once
// The limit as a mesh for pictures, with its curvature.
#include "sublimit/report/asset/curvature_statistics.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit::asset {

/// @param faces  at most, but one a square or triangle; nothing where that is ten times as many. Holes are left out.
AssetSurface display_surface(const LimitMap& surface, const LimitSurface& bound, const LimitTraits& traits,
                             Index faces);

}  // namespace sublimit::asset
