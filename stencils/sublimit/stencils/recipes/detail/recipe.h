// SPDX-License-Identifier: Apache-2.0
#pragma once
// Recipes: classical curves and surfaces as JSON objects with a `kind`, or several in {"recipes": [object,
// ..]}. Linear curves and surfaces are returned as such, with their control points and, if there is one, their
// exact net; other kinds are returned as their data.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sublimit/patches/constructions/spline_net.h"
#include "sublimit/patches/linear_curve.h"
#include "sublimit/stencils/json/exact_number.h"
#include "sublimit/stencils/json/json_value.h"

namespace sublimit {

struct RecipeSurface {
  std::shared_ptr<const Patch> patch;
  Points columns;
  Coordinates coordinates = Coordinates::plain;
  std::optional<SplineNet> net;
  std::string no_net;  ///< reason why there is none
};

struct RecipeCurve {
  std::shared_ptr<const LinearCurve> curve;
  Points columns;  ///< points of any dimension
  Coordinates coordinates = Coordinates::plain;
  std::optional<CurveNet> net;
  std::string no_net;
};

/// `nielson`, `piper`: a triangle with normals, or a mesh.
struct NormalTriangles {
  Points points, normals;      ///< 3 x 3 each; empty if there is a mesh
  std::filesystem::path mesh;  ///< path in the recipe, relative to the recipe's folder
  bool estimated = false;      ///< normals of the mesh are means of its faces', not its `vn`
};

/// A Bezier curve or patch of a join.
struct JoinSide {
  std::vector<int> degree;  ///< one, or two of a patch
  ExactPoints points;       ///< control points, in a patch u fastest; homogeneous: (w x, w y, w z, w)
  bool homogeneous = false;
  ExactNumber length;  ///< length of its parameter interval across the joint, 1 if none is given
};
/// `curve_join`, `surface_join`: u = 1 of left meets u = 0 of right.
struct JoinRecipe {
  JoinSide left, right;
};

/// `implicit`: only its JSON fields.
struct FieldRecipe {
  JsonValue object;
};

struct Recipe {
  std::size_t index = 0;  ///< number of the recipe in the file, from 0
  std::string kind, name, group;
  std::string place;  ///< "file.json: recipe 2 'wing' (ruled)", for messages
  std::variant<RecipeSurface, RecipeCurve, NormalTriangles, JoinRecipe, FieldRecipe> shape;
  std::shared_ptr<const JsonValue> object;  ///< its fields as they are written, for code that computes exactly
  std::vector<std::string> notes;           ///< warnings about accepted input

  const RecipeSurface* surface() const { return std::get_if<RecipeSurface>(&shape); }
  const RecipeCurve* curve() const { return std::get_if<RecipeCurve>(&shape); }
  const NormalTriangles* normal_triangles() const { return std::get_if<NormalTriangles>(&shape); }
  const JoinRecipe* join() const { return std::get_if<JoinRecipe>(&shape); }
};

/// Returns the words for a recipe: "recipe 2 'wing' (ruled)".
std::string label(const Recipe& recipe);

/// Returns all kinds of recipes, in the order of the manual.
std::vector<std::string> recipe_kinds();

/// Reads the recipes of a file.
/// @throws FormatError    invalid contents; the message has file, recipe, field, and what would be right
/// @throws InvalidMesh    curves that do not meet where they must, with the gap
/// @throws IoError        missing, unreadable;  ResourceError  more than memory or 32-bit indices hold
std::vector<Recipe> read_recipes(const std::filesystem::path& path);
/// Reads recipes from text; messages start with `name`.
std::vector<Recipe> parse_recipes(std::string_view text, const std::string& name);

}  // namespace sublimit
