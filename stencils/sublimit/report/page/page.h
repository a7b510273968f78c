// SPDX-License-Identifier: Apache-2.0
#pragma once
// A continuity report as one self-contained page of HTML that needs no network: pictures inline,
// sentences and tables put together by its script (report.html).
#include <nlohmann/json.hpp>

#include <string>

namespace sublimit {

/// Returns the page of a report.
///
/// It is made from the report only (stencils/report_format.md). Unknown keys are ignored, and null quantities
/// shown as dashes. Pictures of surfaces are large, so if there are many valences only some have them, and the
/// page says which.
/// @throws FormatError  not a report, or one of an unknown version
/// @note  Deterministic: the same report gives the same bytes.
std::string report_page(const nlohmann::ordered_json& report);

/// Returns the first figure of the page as the text of an SVG file; empty if it has none.
/// @throws FormatError  as report_page
std::string report_picture(const nlohmann::ordered_json& report);

namespace page {
/// Returns the style sheet of pages, which SVG files carry too.
std::string style();
}  // namespace page

}  // namespace sublimit
