// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/report/page/sections.h"
#include "sublimit/report/page/text.h"
#include "sublimit/report/page/verdicts.h"

namespace sublimit::page {
namespace {

/// Of many schemes only these valences get pictures of surfaces, of one all that the report has surfaces of.
constexpr int pictured[] = {3, 5, 7, 8};

std::set<int> with_pictures(const std::vector<const Json*>& all, bool many_schemes) {
  std::set<int> chosen;
  for (const Json* n : all) {
    const int valence = whole(at(*n, "n"));
    if (at(at(*n, "surface"), "faces").empty()) continue;
    if (!many_schemes || std::find(std::begin(pictured), std::end(pictured), valence) != std::end(pictured))
      chosen.insert(valence);
  }
  if (chosen.empty() && !all.empty()) chosen.insert(whole(at(*all[0], "n")));
  while (chosen.size() > 12) chosen.erase(std::prev(chosen.end()));
  return chosen;
}

std::string split_words(const Json& split) {
  std::string words;
  for (const Json& s : split) words += (words.empty() ? "" : ", ") + literal(s);
  return words;
}

std::string options_words(const Json& options) {
  std::string words;
  if (options.is_object())
    for (const auto& [key, value] : options.items())
      words += (words.empty() ? "" : ", ") + escaped(key) + " = " + literal(value);
  return words;
}

std::string extraordinary(const Json& neighborhoods, const std::string& name, const std::string& id,
                          bool many_schemes) {
  std::string text;
  for (const char* kind : {"vertex", "face"}) {
    std::vector<const Json*> all;
    for (const Json& n : neighborhoods)
      if (string(at(n, "kind")) == kind) all.push_back(&n);
    if (all.empty()) continue;
    text += std::string("<h3>") + (kind[0] == 'v' ? "Extraordinary vertices" : "Extraordinary faces") + "</h3>\n";
    text += over_valences(neighborhoods, kind, name, id);
    const std::set<int> chosen = with_pictures(all, many_schemes);
    if (chosen.size() < all.size()) {
      std::string list;
      for (int v : chosen) list += (list.empty() ? "" : ", ") + std::to_string(v);
      text += "<p class=\"quiet\">Pictures of surfaces are drawn for " + list +
              "; numbers and verdicts are here for all.</p>\n";
    }
    bool opened = false;  // the first extraordinary one, so that the page shows what there is to unfold
    std::vector<bool> open;
    for (const Json* n : all) {
      const int valence = whole(at(*n, "n"));
      open.push_back(!opened && chosen.count(valence) > 0 && (valence == 5 || valence == *chosen.rbegin()));
      opened |= open.back();
    }
    const Detail drawn = many_schemes ? Detail::small_pictures : Detail::pictures;
    std::vector<std::string> parts(all.size());  // in parallel: pictures take their time
    parallel_for_blocks(
        static_cast<std::int64_t>(all.size()),
        [&](std::int64_t i, std::int64_t, std::int64_t) {
          parts[i] = neighborhood_details(
              *all[i], name, id, chosen.count(whole(at(*all[i], "n"))) > 0 ? drawn : Detail::diagrams, open[i]);
        },
        1);
    for (const std::string& part : parts) text += part;
  }
  return text;
}

/// Unequal knot intervals at extraordinary vertices; nothing of other schemes.
std::string knot_intervals(const Json& knots) {
  if (!knots.is_object()) return {};
  std::string text = "<h3>Unequal knot intervals</h3>\n" + verdicts(Json::array({at(knots, "verdict")}));
  const Json& spectra = at(knots, "spectra");
  if (!spectra.is_array() || spectra.empty()) return text;
  Table table{
      "Eigenvalues where the intervals of the spokes, or of a face's corners towards the next one, stay unequal",
      {"intervals", "moduli"},
      {},
      "numbers"};
  for (const Json& row : spectra) {
    std::string spokes, moduli;
    for (const Json& d : at(row, "intervals")) spokes += (spokes.empty() ? "" : ", ") + shown(d);
    for (const Json& value : at(row, "moduli")) moduli += (moduli.empty() ? "" : ", ") + shown(value, 5);
    table.rows.push_back({spokes, moduli});
  }
  return text + html(table);
}

}  // namespace

std::string scheme_section(const Json& scheme, const std::string& id, bool many_schemes) {
  const std::string name = string(at(scheme, "name"), "unnamed");
  const Json& neighborhoods = at(scheme, "neighborhoods");
  std::string text = "<section class=\"scheme\" id=\"" + id + "\"><h2>" + escaped(name) +
                     " <a class=\"up\" href=\"#top\">contents</a></h2>\n";
  if (!string(at(scheme, "source")).empty())
    text += "<p class=\"source\">" + escaped(string(at(scheme, "source"))) + "</p>\n";
  const Json& interpolates = at(scheme, "interpolates");
  text +=
      facts({{"Kind", literal(at(scheme, "kind"))},
             {"Takes", literal(at(scheme, "mesh"))},
             {"Split", split_words(at(scheme, "split"))},
             {"Type", interpolates.is_boolean() ? (is_true(interpolates) ? "interpolating" : "approximating") : dash},
             {"Options", options_words(at(scheme, "options"))}});
  text += claims(at(scheme, "claims"));
  text += regular_part(at(scheme, "regular"), name);
  if (const Json& all = at(scheme, "all_valences"); !all.is_null())
    text += "<h3>All valences at once</h3>\n" + verdicts(Json::array({all}));
  text += knot_intervals(at(scheme, "knot_intervals"));
  text += extraordinary(neighborhoods, name, id, many_schemes);
  text += edge_neighborhoods(neighborhoods, name, id, many_schemes ? Detail::numbers : Detail::diagrams);
  return text + "</section>\n";
}

}  // namespace sublimit::page
