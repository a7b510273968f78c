// SPDX-License-Identifier: Apache-2.0
#pragma once
// The limit as a mesh for pictures, with its curvature.
#include "sublimit/report/asset/curvature_statistics.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit::asset {

/// Returns the surface as a mesh, without holes.
/// @param faces  most faces, but at least one for each address; the result is empty if that is ten times as
///               many
AssetSurface display_surface(const LimitMap& surface, const LimitSurface& bound, const LimitTraits& traits,
                             Index faces);

}  // namespace sublimit::asset
