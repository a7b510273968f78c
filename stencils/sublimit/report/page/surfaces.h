// SPDX-License-Identifier: Apache-2.0
#pragma once
// Figures of limit surfaces: shaded, with reflection lines, coloured by curvature.
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// Returns figures of {"positions", "faces", "normals", "curvature"}: shaded, with reflection lines, with Gauss
/// curvature. Small ones are coarser, but not smaller on the page.
std::string surface_figures(const Json& surface, const std::string& name, bool small);

/// Returns a broad figure of a MESH report: colours by curvature, its worst places numbered, a legend.
std::string asset_figure(const Json& mesh);

/// Returns two figures of a MESH report, zebra stripes and isophotes; empty without normals.
std::string asset_stripes(const Json& mesh);

}  // namespace sublimit::page
