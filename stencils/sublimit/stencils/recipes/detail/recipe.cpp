// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/recipes/detail/recipe.h"

#include <algorithm>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/nearest_names.h"
#include "sublimit/stencils/json/json_file.h"
#include "sublimit/stencils/recipes/detail/recipe_readers.h"

namespace sublimit {
namespace {

std::vector<RecipeKind> all_kinds() {
  std::vector<RecipeKind> all;
  for (const auto family : {curve_kinds(), grid_kinds(), blended_kinds(), construction_kinds(), data_kinds()})
    all.insert(all.end(), family.begin(), family.end());
  return all;
}

/// A word that messages and files of others can hold.
std::string read_label(RecipeObject& object, const std::string& field) {
  if (!object.has(field)) return "";
  std::string label = object.string(field, "a word");
  const bool fits = label.size() <= 200 &&
                    std::ranges::none_of(label, [](char c) { return static_cast<unsigned char>(c) < 32 || c == '#'; });
  if (!fits) object.fail(field, "is too long or has line ends, tabs or '#'; it should be a short text without them");
  return label;
}

RecipeKind find_kind(const std::string& kind, const std::string& place) {
  const std::vector<RecipeKind> all = all_kinds();
  const auto found = std::ranges::find_if(all, [&](const RecipeKind& entry) { return kind == entry.name; });
  if (found != all.end()) return *found;
  throw FormatError(place + ": unknown kind " + show_text(kind) + "; " + nearest_in_words(kind, recipe_kinds()));
}

/// @param what  of which these are the control points
/// @throws FormatError  a sum of the recipe's numbers, which are finite, is not
void check_net(const Points& columns, const std::string& place, const char* what) {
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    if (columns.row(i).allFinite()) continue;
    std::string text;
    for (Eigen::Index c = 0; c < columns.cols(); ++c) text += (c == 0 ? "(" : ", ") + format_number(columns(i, c));
    throw FormatError(place + ": control point " + format_number(i) + " of its " + what + " would be " + text +
                      "): its numbers are so large that their sums and products overflow; another unit of length is "
                      "right");
  }
}
void check_numbers(const Recipe& recipe) {
  const auto check = [&](const auto* shape, const char* what) {
    if (!shape) return;
    check_net(shape->columns, recipe.place, what);
    if (shape->net) check_net(shape->net->columns, recipe.place, "exact net");
  };
  check(recipe.surface(), "surface");
  check(recipe.curve(), "curve");
}

Recipe read_one(const JsonValue& value, std::size_t index, const std::string& file) {
  Recipe recipe;
  recipe.index = index;
  recipe.place = file + ": recipe " + format_number(index);
  if (value.type != JsonValue::Type::object)
    throw FormatError(recipe.place + " is " + show(value) + "; it should be an object {\"kind\": ..}");
  RecipeObject unnamed(value, recipe.place);
  if (unnamed.has("recipes"))
    throw FormatError(recipe.place + " is a list of recipes itself; lists of recipes do not nest");
  recipe.name = read_label(unnamed, "name");
  if (!recipe.name.empty()) recipe.place += " '" + recipe.name + "'";
  recipe.kind = RecipeObject(value, recipe.place).string("kind", "the kind of a curve or surface, such as \"ruled\"");
  const RecipeKind kind = find_kind(recipe.kind, recipe.place);
  recipe.place += " (" + recipe.kind + ")";
  RecipeObject object(value, recipe.place);
  object.has("kind"), object.has("name");
  recipe.group = read_label(object, "group");
  try {
    kind.read(object, recipe);
    check_numbers(recipe);
  } catch (const InvalidParameter& error) {
    throw FormatError(recipe.place + ": " + error.what());
  } catch (const InvalidMesh& error) {
    throw InvalidMesh(recipe.place + ": " + error.what());
  } catch (const ResourceError& error) {
    throw ResourceError(recipe.place + ": " + error.what());
  }
  object.finish();
  return recipe;
}

}  // namespace

std::string label(const Recipe& recipe) {
  return "recipe " + format_number(recipe.index) + (recipe.name.empty() ? "" : " '" + recipe.name + "'") + " (" +
         recipe.kind + ")";
}

std::vector<std::string> recipe_kinds() {
  std::vector<std::string> names;
  for (const RecipeKind& kind : all_kinds()) names.emplace_back(kind.name);
  return names;
}

std::vector<Recipe> parse_recipes(std::string_view text, const std::string& name) {
  const auto whole = std::make_shared<const JsonValue>(parse_json(text, name));
  const JsonValue& root = *whole;
  require_object(root, name, "a recipe is an object {\"kind\": ..}, several are {\"recipes\": [..]}");
  std::vector<Recipe> recipes;
  if (const JsonValue* const list = root.find("recipes"); list && !root.find("kind")) {
    if (list->type != JsonValue::Type::array || list->items.empty())
      throw FormatError(name + ": recipes is " + (list->items.empty() ? "empty" : show(*list)) +
                        "; it should be a list of objects {\"kind\": ..}");
    RecipeObject object(root, name);
    object.has("recipes");
    object.finish();
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      recipes.push_back(read_one(list->items[i], i, name));
      recipes.back().object = {whole, &list->items[i]};
    }
  } else {
    recipes.push_back(read_one(root, 0, name));
    recipes.back().object = whole;
  }
  return recipes;
}

std::vector<Recipe> read_recipes(const std::filesystem::path& path) {
  return parse_recipes(read_json_text(path), path.string());
}

}  // namespace sublimit
