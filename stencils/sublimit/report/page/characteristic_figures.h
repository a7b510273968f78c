// SPDX-License-Identifier: Apache-2.0
#pragma once
// Figures of the characteristic map: iso-lines, the sign of the Jacobian, eigenfunctions on it, the shape
// chart.
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// Returns a figure of the map: its faces coloured by orientation, and the images of parameter lines.
std::string characteristic_map_figure(const Json& neighborhood, const std::string& name);

/// Returns a figure of at most four eigenfunctions as shaded height fields over the map.
std::string eigenfunction_figure(const Json& neighborhood, const std::string& name);

/// Returns a chart of the shapes of second-order behaviour: on a disc of mixtures of the leading eigenfunctions, the
/// sign of the Gauss curvature of the central surface. Empty without eigenfunctions for mu.
std::string shape_chart_figure(const Json& neighborhood, const std::string& name);

}  // namespace sublimit::page
