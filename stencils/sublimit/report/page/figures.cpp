// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/figures.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "sublimit/base/detail/parallel_for.h"

namespace sublimit::page {
namespace {

/// All that is not drawn: what the sentences and tables of the page are made from.
Json without_drawn(const Json& value) {
  static const std::set<std::string, std::less<>> drawn = {"basis",   "eigenfunctions", "faces",  "isolines",
                                                           "labels",  "mask",           "net",    "normals",
                                                           "outline", "pieces",         "points", "surface"};
  static const std::map<std::string, const char*, std::less<>> named = {
      {"characteristic_map", "jacobian"}, {"witness", "kind"}};  // of which one entry is shown
  if (!value.is_structured()) return value;
  Json kept = value.is_array() ? Json::array() : Json::object();
  if (value.is_array())
    for (const Json& part : value) kept.push_back(without_drawn(part));
  else
    for (const auto& [key, part] : value.items())
      if (const auto only = named.find(key); only != named.end() && part.is_object())
        kept[key] = {{only->second, without_drawn(at(part, only->second))}};
      else if (key != "figures" && key != "pictured" && !(part.is_structured() && drawn.contains(key)))
        kept[key] = without_drawn(part);
  return kept;
}

/// Valences that get pictures of surfaces in a report on many schemes; a report on one has all its surfaces drawn.
constexpr int pictured[] = {3, 5, 7, 8};

/// Which vertices or faces, by their valence, get pictures of surfaces.
std::set<int> with_pictures(const Json& neighborhoods, const std::string& kind, bool many_schemes) {
  std::set<int> chosen;
  std::optional<int> first;
  for (const Json& n : neighborhoods) {
    if (string(at(n, "kind")) != kind) continue;
    const int valence = whole(at(n, "n"));
    if (!first) first = valence;
    if (at(at(n, "surface"), "faces").empty()) continue;
    if (!many_schemes || std::find(std::begin(pictured), std::end(pictured), valence) != std::end(pictured))
      chosen.insert(valence);
  }
  if (chosen.empty() && first) chosen.insert(*first);
  while (chosen.size() > 12) chosen.erase(std::prev(chosen.end()));
  return chosen;
}

/// Figures to draw, and where they go in the page's report. Parts that hold others come first: an entry more moves
/// those beside it.
class Drawings {
 public:
  void add(Json& part, std::function<Json()> figures) {
    if (part.is_object()) all_.push_back({&part["figures"], std::move(figures)});
  }
  /// Draws in parallel: pictures take their time.
  void draw() const {
    std::vector<Json> drawn(all_.size());
    parallel_for_blocks(
        std::int64_t(all_.size()), [&](std::int64_t i, std::int64_t, std::int64_t) { drawn[i] = all_[i].second(); }, 1);
    for (std::size_t i = 0; i < drawn.size(); ++i) *all_[i].first = std::move(drawn[i]);
  }

 private:
  std::vector<std::pair<Json*, std::function<Json()>>> all_;
};

Json neighborhood_figures(const Json& n, const std::string& name, bool pictures, bool small) {
  Json figures = {{"map", characteristic_map_figure(n, name)}};
  if (pictures) {
    figures["eigenfunctions"] = eigenfunction_figure(n, name);
    figures["chart"] = shape_chart_figure(n, name);
    add_surface_figures(at(n, "surface"), name, small, figures);
  }
  figures["normals"] = normals_figure(n, name);
  add_mask_figures(n, name, figures);
  return figures;
}

void add_scheme(const Json& scheme, bool many_schemes, Json& page, Drawings& drawings) {
  const std::string name = string(at(scheme, "name"), "unnamed");
  const Json &regular = at(scheme, "regular"), &neighborhoods = at(scheme, "neighborhoods");
  drawings.add(page, [&neighborhoods, name] {
    return Json{{"vertex", valence_figures(neighborhoods, "vertex", name)},
                {"face", valence_figures(neighborhoods, "face", name)}};
  });
  if (page.contains("regular"))
    drawings.add(page["regular"], [&regular, name] {
      return Json{{"mask", regular_mask_figure(regular, name)},
                  {"basis", basis_figure(regular, name)},
                  {"support", support_figure(regular, name)},
                  {"exponent", exponent_figure(at(regular, "smoothness"), name)}};
    });
  if (!neighborhoods.is_array()) return;
  const std::set<int> of_vertices = with_pictures(neighborhoods, "vertex", many_schemes),
                      of_faces = with_pictures(neighborhoods, "face", many_schemes);
  for (std::size_t i = 0; i < neighborhoods.size(); ++i) {
    const Json& n = neighborhoods[i];
    const std::string kind = string(at(n, "kind")), count = std::to_string(whole(at(n, "n")));
    const bool is_inside = kind == "vertex" || kind == "face";
    if (!is_inside && many_schemes) continue;  // numbers only
    Json& part = page["neighborhoods"][i];
    const bool pictures = is_inside && (kind == "face" ? of_faces : of_vertices).contains(whole(at(n, "n")));
    if (pictures && part.is_object()) part["pictured"] = true;
    drawings.add(
        part, [&n, pictures, many_schemes, words = (kind == "vertex" ? "valence " : kind + " ") + count + ", " + name] {
          return neighborhood_figures(n, words, pictures, many_schemes);
        });
  }
}

}  // namespace

Json with_figures(const Json& report) {
  Json page = without_drawn(report);
  Drawings drawings;
  const auto add = [&](const char* key, Json (*figures)(const Json&)) {
    if (const Json& part = at(report, key); part.is_object())
      drawings.add(page[key], [&part, figures] { return figures(part); });
  };
  add("mesh", mesh_figures);
  add("free_form", [](const Json& shapes) { return Json{{"shapes", free_form_figure(shapes)}}; });
  add("curve", [](const Json& curve) { return Json{{"curve", curve_figure(curve)}}; });
  add("sweep", [](const Json& sweep) { return Json{{"sweep", sweep_figure(sweep)}}; });
  if (const Json& schemes = at(report, "schemes"); schemes.is_array())
    for (std::size_t s = 0; s < schemes.size(); ++s)
      add_scheme(schemes[s], schemes.size() > 1, page["schemes"][s], drawings);
  drawings.draw();
  return page;
}

}  // namespace sublimit::page
