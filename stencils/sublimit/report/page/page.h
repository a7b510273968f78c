// SPDX-License-Identifier: Apache-2.0
#pragma once
// A continuity report as one page of HTML that needs nothing but itself: no network, no scripts, pictures inline.
#include <nlohmann/json.hpp>

#include <string>

namespace sublimit {

/// The page of a report.
///
/// Drawn from the report alone (stencils/report_format.md); unknown keys are ignored, quantities that are null are
/// dashes. Pictures of surfaces are many bytes, so of many valences only some get them, and the page says which.
/// @throws FormatError  if this is not a report, or of a version that is not known
/// @note  Deterministic: the same report gives the same bytes.
std::string report_page(const nlohmann::ordered_json& report);

/// The page's first figure as an SVG file of its own; empty if it has none.
/// @throws FormatError  as report_page
std::string report_picture(const nlohmann::ordered_json& report);

}  // namespace sublimit
