// SPDX-License-Identifier: Apache-2.0
#pragma once
// Vertices where the scheme has a tangent plane, but the limit has no normal because the control points are
// degenerate there.
#include "sublimit/report/asset/inventory.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit::asset {

std::vector<AssetWarning> undefined_normals(const LimitMap& surface, const LimitSurface& bound,
                                            const Inventory& inventory, const Points& points, Index listed);

}  // namespace sublimit::asset
