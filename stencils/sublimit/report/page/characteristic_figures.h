// SPDX-License-Identifier: Apache-2.0
#pragma once
// The characteristic map and what lives on it: iso-lines, the sign of the Jacobian, eigenfunctions, shape chart.
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// The map: its faces by orientation, the images of parameter lines.
std::string characteristic_map_figure(const Json& neighborhood, const std::string& name);

/// Eigenfunctions as shaded height fields over the map, at most four.
std::string eigenfunction_figure(const Json& neighborhood, const std::string& name);

/// Returns a chart of the shapes of second-order behaviour: on a disc of mixtures of the leading eigenfunctions, the
/// sign of the Gauss curvature of the central surface. Empty without eigenfunctions for mu.
std::string shape_chart_figure(const Json& neighborhood, const std::string& name);

}  // namespace sublimit::page
