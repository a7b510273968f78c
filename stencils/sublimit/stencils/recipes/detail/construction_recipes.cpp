// SPDX-License-Identifier: Apache-2.0
#include <numbers>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/constructions/revolution.h"
#include "sublimit/patches/constructions/ruled.h"
#include "sublimit/patches/constructions/screw_surface.h"
#include "sublimit/patches/constructions/swept.h"
#include "sublimit/stencils/recipes/detail/recipe_readers.h"

namespace sublimit {
namespace {

void read_ruled(RecipeObject& object, Recipe& recipe) {
  CurveNet c0 = read_inner_curve(object, "c0", recipe.notes), c1 = read_inner_curve(object, "c1", recipe.notes);
  set_surface(recipe, ruled(std::move(c0), std::move(c1)));
}

void read_extrusion(RecipeObject& object, Recipe& recipe) {
  const CurveNet curve = read_inner_curve(object, "curve", recipe.notes);
  set_surface(recipe, extrusion(curve, object.space_vector("direction")));
}

void read_cone(RecipeObject& object, Recipe& recipe) {
  const CurveNet curve = read_inner_curve(object, "curve", recipe.notes);
  set_surface(recipe, cone(curve, object.space_vector("apex")));
}

void read_translational(RecipeObject& object, Recipe& recipe) {
  CurveNet c = read_inner_curve(object, "c", recipe.notes), d = read_inner_curve(object, "d", recipe.notes);
  set_surface(recipe, translational(std::move(c), std::move(d), object.space_vector("origin")));
}

/// {degree, knots, homogeneous_xzw} or {degree, knots, points}, points (x, z).
CurveNet read_profile(RecipeObject& object, std::vector<std::string>& notes) {
  RecipeObject profile =
      object.object("profile", "a curve {degree, knots, homogeneous_xzw} or {degree, knots, points}");
  const int degree = profile.integer("degree", 0, max_degree);
  const bool rational = profile.has("homogeneous_xzw");
  if (rational && profile.has("points"))
    profile.fail("homogeneous_xzw", "comes with points; one of them has the control points");
  if (!rational && !profile.has("points"))
    profile.required("homogeneous_xzw", "a list of columns [w x, w z, w], or points a list of [x, z]");
  Points columns = rational ? profile.points("homogeneous_xzw", 3, 3) : profile.points("points", 2, 2);
  Knots<double> knots = read_knots(profile, "knots", degree, columns.rows(), profile.flag_or("closed", false), notes);
  profile.finish();
  return {std::move(knots), std::move(columns), rational ? Coordinates::homogeneous : Coordinates::plain};
}

void read_revolution(RecipeObject& object, Recipe& recipe) {
  const CurveNet profile = read_profile(object, recipe.notes);
  RevolutionOptions options{.start_degrees = object.number_or("start_degrees", 0),
                            .sweep_degrees = object.number_or("sweep_degrees", 360),
                            .arcs = object.integer_or("arcs", 1, 1000, 0),
                            .axis = {}};
  if (object.has("axis")) {
    RecipeObject axis = object.object("axis", "{point: [x, y, z], direction: [x, y, z]}");
    if (axis.has("point")) options.axis.point = axis.space_vector("point");
    options.axis.direction = axis.space_vector("direction");
    axis.finish();
  }
  set_surface(recipe, revolution(profile, options));
}

void read_screw(RecipeObject& object, Recipe& recipe) {
  const CurveNet curve = read_inner_curve(object, "curve", recipe.notes);
  const double pitch = object.number("pitch").value;
  const std::vector<double> range =
      object.has("u") ? object.numbers("u", 2) : std::vector<double>{0, 2 * std::numbers::pi};
  auto patch = std::make_shared<const ScrewSurface>(curve.knots, range[0], range[1]);
  Points columns = patch->columns(curve, pitch);
  recipe.shape = RecipeSurface{std::move(patch), std::move(columns), curve.coordinates, std::nullopt,
                               "it is made of cos u, sin u and u, which no B-spline has together"};
}

void read_sweep(RecipeObject& object, Recipe& recipe) {
  const CurveNet section = read_inner_curve(object, "section", recipe.notes);
  const int degree = object.integer("degree", 0, max_degree);
  const Points origins = object.space_points("origins");
  const Knots<double> path =
      read_knots(object, "knots", degree, origins.rows(), object.flag_or("closed", false), recipe.notes);
  std::vector<Eigen::Matrix3d> matrices;
  for (const Points& rows : object.lists_of_points("matrices", 3, 3)) {
    if (rows.rows() != 3)
      object.fail("matrices[" + format_number(matrices.size()) + "]",
                  "has " + format_number(rows.rows()) + " rows; it should have 3 of 3 numbers");
    matrices.emplace_back(rows);
  }
  set_surface(recipe, sweep(section, path, origins, matrices));
}

void read_loft(RecipeObject& object, Recipe& recipe) {
  const int degree_u = object.integer("degree_u", 0, max_degree), degree_v = object.integer("degree_v", 0, max_degree);
  const std::vector<double> parameters = object.numbers("parameters");
  std::vector<CurveNet> sections;
  for (const Points& given : object.lists_of_points("sections", 2, 3)) {
    Points columns = in_space(given);
    std::vector<std::string>* const notes = &recipe.notes;
    std::vector<std::string> again;
    Knots<double> knots =
        read_knots(object, "knots_u", degree_u, columns.rows(), false, sections.empty() ? *notes : again);
    sections.push_back({std::move(knots), std::move(columns)});
  }
  set_surface(recipe, loft(std::move(sections), degree_v, parameters));
}

constexpr RecipeKind kinds_of_constructions[] = {
    {"ruled", read_ruled},
    {"extrusion", read_extrusion},
    {"cone", read_cone},
    {"translational", read_translational},
    {"revolution", read_revolution},
    {"screw", read_screw},
    {"sweep", read_sweep},
    {"loft", read_loft},
};

}  // namespace

std::span<const RecipeKind> construction_kinds() { return kinds_of_constructions; }

}  // namespace sublimit
