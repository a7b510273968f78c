// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/page.h"

#include <initializer_list>

#include "sublimit/base/error.h"
#include "sublimit/report/page/figures.h"
#include "sublimit/report/page/json.h"

namespace sublimit {
namespace page {
namespace {

/// The page without its report.
constexpr const char* page_template =
#include "report.html.inc"
    ;

/// Returns the text between two marks of the template.
std::string between(const std::string& begin, const std::string& end) {
  const std::string text = page_template;
  const std::size_t first = text.find(begin) + begin.size();
  return text.substr(first, text.find(end, first) - first);
}

void check(const Json& report) {
  if (string(at(report, "format")) != "sublimit-report")
    throw FormatError("report page: \"format\" is not \"sublimit-report\"; give it a report.json of sublimit analyze");
  if (whole(at(report, "version")) != 1)
    throw FormatError("report page: version " + at(report, "version").dump() +
                      " of the report is not known; this program reads version 1");
}

/// The first SVG among figures, in the order of the page.
std::string first_svg(const Json& value) {
  if (value.is_object() && at(value, "svg").is_string()) return string(at(value, "svg"));
  if (value.is_structured())
    for (const Json& part : value)
      if (std::string svg = first_svg(part); !svg.empty()) return svg;
  return {};
}

}  // namespace

std::string style() { return between("<style>", "</style>"); }

}  // namespace page

std::string report_page(const nlohmann::ordered_json& report) {
  page::check(report);
  std::string data = page::with_figures(report).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  for (std::size_t at = 0; (at = data.find('<', at)) != std::string::npos;)
    data.replace(at, 1, "\\u003c");  // in strings only: no text of the report ends the script that it is in
  std::string html = page::page_template;
  const std::string place = "id=\"report\">{}";
  html.replace(html.find(place) + place.size() - 2, 2, data);
  return html;
}

std::string report_picture(const nlohmann::ordered_json& report) {
  page::check(report);
  const page::Json figures = page::with_figures(report);
  std::string svg;
  for (const char* part : {"mesh", "free_form", "curve", "sweep", "schemes"})
    if (svg.empty()) svg = page::first_svg(page::at(figures, part));
  if (svg.empty()) return {};
  return svg.insert(svg.find('>') + 1, "<style>" + page::style() + "</style>") + (svg.ends_with('\n') ? "" : "\n");
}

}  // namespace sublimit
