// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "sublimit/report/page/characteristic_figures.h"
#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/mask_diagram.h"
#include "sublimit/report/page/plot.h"
#include "sublimit/report/page/sections.h"
#include "sublimit/report/page/surfaces.h"
#include "sublimit/report/page/verdicts.h"

namespace sublimit::page {
namespace {

std::string title(const Json& neighborhood) {
  const std::string kind = string(at(neighborhood, "kind")), n = std::to_string(whole(at(neighborhood, "n")));
  if (kind == "vertex") return "Valence " + n;
  if (kind == "face") return "Face with " + n + " corners";
  const std::string faces = n == "1" ? "1 face" : n + " faces";
  if (kind == "border") return "Border, " + faces;
  if (kind == "crease") return "Side of a crease, " + faces;
  if (kind == "corner") return "Corner, " + faces;
  if (kind == "dart") return "Dart, valence " + n;
  return escaped(kind) + " " + n;
}

std::string spectrum_table(const Json& neighborhood) {
  const Json& spectrum = at(neighborhood, "spectrum");
  if (!spectrum.is_array() || spectrum.empty()) return {};
  Table table{"Eigenvalues of the local matrix by descending modulus",
              {"modulus", "block", "exact", "enclosure", "multiplicity", "Jordan blocks"},
              {},
              "numbers"};
  constexpr std::size_t most = 24;
  for (std::size_t i = 0; i < spectrum.size() && i < most; ++i) {
    const Json& e = spectrum[i];
    const Json& value = at(e, "value");
    std::string modulus = shown(at(e, "modulus"), 10);
    if (const double im = number(at(value, 1)).value_or(0); im != 0)
      modulus += " <span class=\"quiet\">= |" + shown(at(value, 0), 5) + (im > 0 ? " + " : " − ") +
                 shown(std::abs(im), 5) + "i|</span>";
    std::string enclosure = string(at(e, "enclosure"));
    if (const std::size_t cut = enclosure.find(" +/-"); cut != std::string::npos && cut > 26) {
      enclosure = enclosure.substr(0, 24) + "…" + enclosure.substr(cut);
    }
    std::string block = shown(at(e, "block"));
    if (whole(at(e, "copies"), 1) == 2) block = "±" + block;
    const int multiplicity = whole(at(e, "multiplicity"), 1), geometric = whole(at(e, "geometric"), multiplicity);
    std::string jordan;
    for (const Json& size : at(e, "jordan")) jordan += (jordan.empty() ? "" : ", ") + shown(size);
    if (jordan.empty()) jordan = geometric < multiplicity ? "defective" : "";
    table.rows.push_back({modulus, block, exact_number(at(e, "exact")),
                          enclosure.empty() ? dash : "<span class=\"code\">" + escaped(enclosure) + "</span>",
                          shown(at(e, "multiplicity")), geometric < multiplicity ? "<b>" + jordan + "</b>" : jordan});
  }
  std::string text = html(table);
  if (spectrum.size() > most)
    text += "<p class=\"quiet\">" + std::to_string(spectrum.size() - most) + " smaller ones are in the report.</p>\n";
  return "<details><summary>Spectrum: " + std::to_string(spectrum.size()) + " eigenvalues</summary>" + text +
         "</details>\n";
}

std::string normals_figure(const Json& neighborhood, const std::string& name) {
  const Json& normals = at(neighborhood, "normals");
  const Json &steps = at(normals, "steps"), &spread = at(normals, "spread_degrees");
  Plot plot{"Spread of normals by ring, " + name, "", "steps", "degrees"};
  plot.log_y = true;
  Series s{"", {}, 0};
  for (std::size_t i = 0; i < steps.size() && i < spread.size(); ++i)
    s.points.emplace_back(number(at(steps, i)).value_or(static_cast<double>(i)), number(at(spread, i)));
  plot.series = {s};
  return figure(
      plot,
      "<b>Spread of the normals</b> in the ring around the point after so many steps. With a tangent plane it "
      "goes to zero, like a power where the plane is reached quickly.");
}

std::string headline(const Json& neighborhood) {
  std::string text = "<span class=\"quiet\">λ = " + shown(at(neighborhood, "lambda"), 6);
  if (!at(neighborhood, "ratio").is_null()) text += ", μ/λ<sup>2</sup> = " + shown(at(neighborhood, "ratio"), 5);
  text += "</span>";
  for (const char* property : {"c1", "tangent-plane"}) {
    const Json& v = verdict_on(at(neighborhood, "verdicts"), property);
    if (!v.is_null())
      text += std::string(" <span class=\"quiet\">") + (property[0] == 'c' ? "C<sup>1</sup>" : "tangent plane") +
              "</span> " + badge(at(v, "verdict"));
  }
  return text;
}

}  // namespace

std::string neighborhood_details(const Json& neighborhood, const std::string& scheme, const std::string& id,
                                 Detail detail, bool open) {
  std::string heading = title(neighborhood);
  std::string name = heading + ", " + scheme;
  name[0] = static_cast<char>(std::tolower(name[0]));
  std::string text = "<details id=\"" + id + "-" + identifier(string(at(neighborhood, "kind"))) + "-" +
                     std::to_string(whole(at(neighborhood, "n"))) + "\"" + (open ? " open" : "") + "><summary>" +
                     heading + " " + headline(neighborhood) + "</summary>\n";
  text += verdicts(at(neighborhood, "verdicts"));
  if (detail != Detail::numbers) {
    const bool pictures = detail >= Detail::small_pictures;
    std::string all = characteristic_map_figure(neighborhood, name);
    if (pictures) all += eigenfunction_figure(neighborhood, name) + shape_chart_figure(neighborhood, name);
    if (pictures) all += surface_figures(at(neighborhood, "surface"), name, detail == Detail::small_pictures);
    text += figures(all + normals_figure(neighborhood, name));
    text += neighborhood_masks(neighborhood, name);
  }
  return text + spectrum_table(neighborhood) + "</details>\n";
}

std::string edge_neighborhoods(const Json& neighborhoods, const std::string& scheme, const std::string& id,
                               Detail detail) {
  constexpr std::array<std::pair<const char*, const char*>, 4> kinds = {
      {{"border", "Borders"}, {"crease", "Creases, one side"}, {"corner", "Corners"}, {"dart", "Darts"}}};
  std::string text;
  for (const auto& [kind, words] : kinds) {
    Table table{words,
                {std::string(kind) == "dart" ? "valence" : "faces", "λ", "μ", "tangent plane", "because"},
                {},
                "wide text"};
    std::string each;
    for (const Json& n : neighborhoods) {
      if (string(at(n, "kind")) != kind) continue;
      const Json& list = at(n, "verdicts");
      const Json& plane =
          verdict_on(list, "tangent-plane").is_null() ? verdict_on(list, "c1") : verdict_on(list, "tangent-plane");
      const std::string count = std::to_string(whole(at(n, "n")));
      table.rows.push_back({"<a href=\"#" + id + "-" + kind + "-" + count + "\">" + count + "</a>",
                            shown(at(n, "lambda"), 8), shown(at(n, "mu"), 8), badge(at(plane, "verdict")),
                            prose(at(plane, "because"))});
      each += neighborhood_details(n, scheme, id, detail, false);
    }
    if (!table.rows.empty()) text += html(table) + "<details><summary>Each of them</summary>\n" + each + "</details>\n";
  }
  return text.empty() ? text : "<h3>Borders, creases, corners, darts</h3>\n" + text;
}

}  // namespace sublimit::page
