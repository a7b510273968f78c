// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit surfaces: shaded, in a striped world, coloured by curvature.
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// Figures of {"positions", "faces", "normals", "curvature"}: shaded, with reflection lines, with Gauss curvature.
/// Small ones are coarser, not smaller on the page.
std::string surface_figures(const Json& surface, const std::string& name, bool small);

/// One broad figure of an asset: curvature colours and its worst places, numbered; with legend.
std::string asset_figure(const Json& mesh);

/// Two more: zebra stripes and isophotes; none without normals.
std::string asset_stripes(const Json& mesh);

}  // namespace sublimit::page
