// SPDX-License-Identifier: Apache-2.0
// Kinds that come as their data: triangles with normals, joins, fields.
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/stencils/recipes/detail/recipe_readers.h"

namespace sublimit {
namespace {

void read_normal_triangles(RecipeObject& object, Recipe& recipe) {
  NormalTriangles triangles;
  if (object.has("mesh")) {
    if (object.has("points")) object.fail("mesh", "comes with points; a mesh has its own");
    triangles.mesh = object.string("mesh", "the name of an OBJ file");
    if (triangles.mesh.empty()) object.fail("mesh", "is empty; it should be the name of an OBJ file");
    constexpr const char* words[] = {"given", "estimated"};
    triangles.estimated = object.word_or("normals", words, 0) == 1;
  } else {
    triangles.points = object.space_points("points", 3);
    triangles.normals = object.space_points("normals", 3);
  }
  recipe.shape = std::move(triangles);
}

template <std::size_t variables>
JoinSide read_side(RecipeObject& object, const char* field) {
  RecipeObject side = object.object(
      field, variables == 1 ? "a Bezier curve {points, length}" : "a Bezier patch {degree, points, length}");
  JoinSide result;
  result.homogeneous = side.has("homogeneous");
  if (result.homogeneous && side.has("points"))
    side.fail("homogeneous", "comes with points; one of them has the control points");
  result.points = result.homogeneous ? side.exact_points("homogeneous", 3, 4) : side.exact_points("points", 2, 3);
  const auto count = static_cast<std::int64_t>(result.points.size());
  if constexpr (variables == 1) {
    if (count < 2) side.fail("points", "has one point; a curve that joins needs 2 at least");
    result.degree = {static_cast<int>(count) - 1};
    if (side.has("degree") && side.integer("degree", 1, 1 << 30) != result.degree[0])
      side.fail("degree", "does not fit " + format_number(count) + " points");
  } else {
    result.degree = side.integers("degree", 2, 1, 1000);
    const std::int64_t wanted = (result.degree[0] + std::int64_t{1}) * (result.degree[1] + 1);
    if (count != wanted)
      side.fail(result.homogeneous ? "homogeneous" : "points",
                "has " + format_number(count) + " points; the degrees need " + format_number(wanted));
  }
  result.length = {.value = 1, .text = "1", .numerator = 1, .denominator = 1};
  if (side.has("length")) result.length = side.number("length");
  if (!(result.length.value > 0)) side.fail("length", "is " + result.length.text + "; it should be more than 0");
  side.finish();
  return result;
}

template <std::size_t variables>
void read_join(RecipeObject& object, Recipe& recipe) {
  JoinSide left = read_side<variables>(object, "left"), right = read_side<variables>(object, "right");
  recipe.shape = JoinRecipe{std::move(left), std::move(right)};
}

void read_field(RecipeObject& object, Recipe& recipe) {
  object.required("field", "a field, {\"field\": \"sphere\", ..}");
  for (const std::string& key : object.value().keys) object.has(key);
  recipe.shape = FieldRecipe{object.value()};
}

constexpr RecipeKind kinds_of_data[] = {
    {"nielson", read_normal_triangles}, {"piper", read_normal_triangles}, {"curve_join", read_join<1>},
    {"surface_join", read_join<2>},     {"implicit", read_field},
};

}  // namespace

std::span<const RecipeKind> data_kinds() { return kinds_of_data; }

}  // namespace sublimit
