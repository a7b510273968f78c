// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/sections.h"
#include "sublimit/report/page/text.h"

namespace sublimit::page {
namespace {

std::string with_badge(const Json& continuity, const Json& verdict) {
  return continuity.is_null() ? std::string(dash) : prose(continuity) + " " + badge(verdict);
}

/// The valences that a verdict holds for, beside it.
std::string where(const Json& valences) {
  return string(valences).empty() ? std::string() : " at valence " + literal(valences);
}

}  // namespace

std::string summary_section(const Json& report) {
  const Json& rows = at(report, "summary");
  if (!rows.is_array() || rows.empty()) return {};
  Table table{"Everything in it is computed from the masks",
              {"scheme", "type", "mesh", "regular", "extraordinary points", "notes"},
              {},
              "wide text"};
  for (const Json& row : rows) {
    const std::string name = string(at(row, "scheme"));
    table.rows.push_back(
        {"<a href=\"#scheme-" + identifier(name) + "\">" + escaped(name) + "</a>", literal(at(row, "type")),
         literal(at(row, "mesh")), with_badge(at(row, "regular"), at(row, "regular_verdict")),
         with_badge(at(row, "extraordinary"), at(row, "extraordinary_verdict")) + where(at(row, "valences")),
         prose(at(row, "notes"))});
  }
  return "<section id=\"summary\"><h2>Schemes side by side</h2>\n" + html(table) + "</section>\n";
}

}  // namespace sublimit::page
