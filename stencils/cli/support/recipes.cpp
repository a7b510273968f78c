// SPDX-License-Identifier: Apache-2.0
#include "support/recipes.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/normal_surfaces.h"
#include "sublimit/stencils/jobs/detail/mesh_info_json.h"

namespace sublimit::cli {

void tell_notes(const std::vector<Recipe>& recipes) {
  for (const Recipe& recipe : recipes)
    for (const std::string& note : recipe.notes) fmt::print(stderr, "sublimit: warning: {}: {}\n", recipe.place, note);
}

void tell_left_out(const Source& source, Sampled taken) {
  if (source.common.quiet) return;
  for (const Recipe& recipe : *source.recipes) {
    const char* why = nullptr;
    if (recipe.surface()) {
      if (taken == Sampled::curves) why = "a surface; without --curves it is sampled";
    } else if (recipe.curve()) {
      if (taken != Sampled::curves) why = "a curve; with --curves it is sampled, by segment,t";
    } else if (recipe.normal_triangles()) {
      if (taken == Sampled::curves) why = "a surface; without --curves it is sampled";
      if (taken == Sampled::surfaces)
        why = "it is not linear in its points, as the other surfaces are; in a file without them it is sampled";
    } else if (recipe.join()) {
      why = "a join of two; `sublimit analyze` says how smooth it is";
    } else {
      why = "a kind that is not sampled";
    }
    if (why) fmt::print(stderr, "sublimit: warning: {} is left out: {}\n", recipe.place, why);
  }
}

namespace {

/// What `info` tells of one recipe, as data and in words.
struct RecipeWords {
  nlohmann::ordered_json json;
  std::string text;
  std::vector<std::string> notes;
};

/// Numbers that its faces or segments have, behind those of recipes before.
void describe_range(RecipeWords& words, const char* what, Index& first, Index count) {
  words.json[what] = {first, first + count - 1};
  words.text += fmt::format(", {} {} to {}", what, first, first + count - 1);
  first += count;
}

void describe_net(RecipeWords& words, const char* points, Index count, const std::string& no_net) {
  words.json["control_points"] = count;
  words.json["exact_net"] = no_net.empty() ? "yes" : "no: " + no_net;
  words.text += fmt::format(", {} {}; exact net: {}", count, points, no_net.empty() ? "yes" : "no, " + no_net);
}

/// @tparam Shape  a surface or a curve
template <class Shape>
void describe_linear(RecipeWords& words, const Shape& shape, const char* what, Index& first, Index count) {
  const bool rational = shape.coordinates == Coordinates::homogeneous;
  words.json["rational"] = rational;
  if (rational) words.text += ", rational";
  describe_range(words, what, first, count);
  describe_net(words, "control points", static_cast<Index>(shape.columns.rows()), shape.net ? "" : shape.no_net);
}

void describe_normal_triangles(RecipeWords& words, const NormalSurface& surface, bool is_sampled, Index& first) {
  words.json["patches"] = surface.data.num_faces();
  words.text += fmt::format(", {} patches", surface.data.num_faces());
  if (is_sampled) describe_range(words, "faces", first, surface.data.num_faces());
  describe_net(words, "points with normals", surface.data.num_vertices(), "it is not linear in its points");
  const std::vector<std::string> notes = surface.scheme.notes(surface.data);
  words.notes.insert(words.notes.end(), notes.begin(), notes.end());
  if (!is_sampled) words.notes.push_back("left out of samples: other surfaces of the file are linear in their points");
}

}  // namespace

void print_recipes(const Source& source, bool json, const std::optional<LimitIntegrals>& integrals) {
  const Common& common = source.common;
  const std::vector<Recipe>& recipes = *source.recipes;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  std::string text = fmt::format("{}\n  {} recipes\n", common.mesh, recipes.size());
  Index face = 0, segment = 0;  // of those before
  const bool linear = std::ranges::any_of(recipes, [](const Recipe& recipe) { return recipe.surface() != nullptr; });
  Common quiet = common;
  quiet.quiet = true;
  Progress progress(common.quiet);
  for (const Recipe& recipe : recipes) {
    RecipeWords words{.json = {{"index", recipe.index}, {"kind", recipe.kind}, {"name", recipe.name}},
                      .text = fmt::format("  recipe {}: {}{}", recipe.index, recipe.kind,
                                          recipe.name.empty() ? "" : " '" + recipe.name + "'"),
                      .notes = recipe.notes};
    if (const RecipeSurface* const surface = recipe.surface())
      describe_linear(words, *surface, "faces", face, surface->patch->faces().size);
    else if (const RecipeCurve* const curve = recipe.curve())
      describe_linear(words, *curve, "segments", segment, curve->curve->num_segments());
    else if (recipe.normal_triangles())
      describe_normal_triangles(words, load_normal_surface(quiet, recipe, progress), !linear, face);
    else if (recipe.join())
      words.text += ": two pieces; `sublimit analyze` says how smoothly they join";
    words.json["notes"] = words.notes;
    list.push_back(std::move(words.json));
    text += words.text + "\n";
    for (const std::string& note : words.notes) text += "    note: " + note + "\n";
  }
  progress.step("");
  if (json) {
    nlohmann::ordered_json all{{"file", common.mesh}, {"recipes", list}};
    if (integrals) all["limit"] = to_json(*integrals);
    text = all.dump(2) + "\n";
  }
  fmt::print("{}", text);
}

}  // namespace sublimit::cli
