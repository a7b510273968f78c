// SPDX-License-Identifier: Apache-2.0
#pragma once
// Vertices where the limit has no normal: not for want of a plane, but because the control points make it degenerate.
#include "sublimit/report/asset/inventory.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit::asset {

std::vector<AssetWarning> undefined_normals(const LimitMap& surface, const LimitSurface& bound,
                                            const Inventory& inventory, const Points& points, Index listed);

}  // namespace sublimit::asset
