// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/recipes/construct.h"

#include <utility>
#include <variant>

#include "sublimit/base/error.h"
#include "sublimit/io/free_form.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/recipes/detail/net_file.h"
#include "sublimit/stencils/recipes/detail/recipe_sources.h"

namespace sublimit {

struct Curves::Bound {
  CurveSet set;
  Points columns;
  Coordinates coordinates = Coordinates::plain;
};

Curves::Curves(CurveSet set, Points columns, Coordinates coordinates)
    : bound_(std::make_shared<const Bound>(Bound{std::move(set), std::move(columns), coordinates})) {}
const CurveSet& Curves::set() const { return bound_->set; }
const Points& Curves::points() const { return bound_->columns; }
bool Curves::rational() const { return bound_->coordinates == Coordinates::homogeneous; }
CurveSamples Curves::evaluate(std::span<const CurvePlace> places, int derivatives) const {
  return bound_->set.evaluate(bound_->columns, places, derivatives, bound_->coordinates);
}

struct Construction::Made {
  std::string name;  // of the file, for messages
  std::variant<std::vector<Recipe>, FreeForm> shapes;
  std::vector<std::string> names, notes;
};

const std::vector<std::string>& Construction::names() const& { return made_->names; }
const std::vector<std::string>& Construction::notes() const& { return made_->notes; }

Patches Construction::surfaces() const {
  if (const auto* const recipes = std::get_if<std::vector<Recipe>>(&made_->shapes)) {
    RecipePatches found = recipe_patches(*recipes, made_->name);
    return {std::move(found.patches), std::move(found.columns)};
  }
  FreeFormPatches found = free_form_patches(std::get<FreeForm>(made_->shapes), made_->name);
  return {std::move(found.patches), std::move(found.columns)};
}

Curves Construction::curves() const {
  if (const auto* const recipes = std::get_if<std::vector<Recipe>>(&made_->shapes)) {
    RecipeCurves found = recipe_curves(*recipes, made_->name);
    return {std::move(found.curves), std::move(found.columns), found.coordinates};
  }
  FreeFormCurves found = free_form_curves(std::get<FreeForm>(made_->shapes), made_->name);
  return {std::move(found.curves), std::move(found.columns), found.coordinates};
}

void Construction::write(const std::filesystem::path& path) const {
  if (!all_formats().writes(path, contents::free_form))
    throw InvalidOption(path.string() + ": exact nets are written as " +
                        all_formats().writers_in_words({contents::free_form}, "or") + ", not as '" +
                        file_extension(path) + "'");
  if (const auto* const recipes = std::get_if<std::vector<Recipe>>(&made_->shapes))
    return write_free_form(path, net_file(*recipes));
  write_free_form(path, std::get<FreeForm>(made_->shapes));
}

Construction construct(const std::string& recipe) {
  Construction::Made made;
  const size_t first = recipe.find_first_not_of(" \t\r\n");
  const bool is_json = first != std::string::npos && recipe[first] == '{';
  made.name = is_json ? "recipe" : recipe;
  if (!is_json && !all_formats().reads(recipe, contents::recipes)) {
    FreeForm shapes = read_free_form(recipe);
    for (const auto& surface : shapes.surfaces) made.names.push_back("line " + std::to_string(surface.line));
    for (const auto& curve : shapes.curves) made.names.push_back("line " + std::to_string(curve.line));
    made.shapes = std::move(shapes);
  } else {
    std::vector<Recipe> recipes = is_json ? parse_recipes(recipe, made.name) : read_recipes(recipe);
    for (const Recipe& one : recipes) {
      made.names.push_back(label(one));
      for (const std::string& note : one.notes) made.notes.push_back(one.place + ": " + note);
    }
    made.shapes = std::move(recipes);
  }
  return Construction(std::make_shared<const Construction::Made>(std::move(made)));
}

}  // namespace sublimit
