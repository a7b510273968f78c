// SPDX-License-Identifier: Apache-2.0
// What readers of several kinds share.
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/spline_curve.h"
#include "sublimit/stencils/recipes/detail/recipe_readers.h"

namespace sublimit {

GivenColumns read_columns(RecipeObject& object, bool in_any_dimension, std::vector<std::string>& notes) {
  constexpr std::size_t most = 1000;  // coordinates
  const bool homogeneous = object.has("homogeneous");
  if (homogeneous && object.has("points"))
    object.fail("homogeneous", "comes with points; one of them has the control points");
  if (!homogeneous && !object.has("points"))
    object.required("points", "a list of control points, or homogeneous a list of columns [w x, w y, w z, w]");
  if (!homogeneous)
    return {in_any_dimension ? object.points("points", 1, most) : object.space_points("points"), Coordinates::plain};
  GivenColumns result{in_any_dimension ? object.points("homogeneous", 2, most + 1) : object.points("homogeneous", 4, 4),
                      Coordinates::homogeneous};
  if (result.columns.rightCols(1).isZero(0)) object.fail("homogeneous", "all weights are 0; one at least must not be");
  if (const Index count = num_weights_not_positive(result.columns); count > 0)
    notes.push_back(format_number(count) +
                    " weights are not positive: the convex hull property is lost, and there may " + "be poles");
  return result;
}

Knots<double> read_knots(RecipeObject& object, const std::string& field, int degree, Eigen::Index points, bool closed,
                         std::vector<std::string>& notes) {
  const std::vector<double> values = object.numbers(field);
  try {
    if (closed) {
      if (std::ssize(values) != points + 1)
        throw InvalidParameter(format_number(values.size()) +
                               " break points of a closed spline: " + format_number(points + 1) + " are needed for " +
                               format_number(points) + " control points");
      return Knots<double>::closed(degree, values);
    }
    Knots<double> knots = Knots<double>::open(degree, static_cast<Index>(points), values);
    if (knots.ends_were_doubled())
      notes.push_back(field + ": the first and the last are left out, as in openNURBS; these ends are doubled");
    return knots;
  } catch (const InvalidParameter& error) {
    object.fail(field, error.what());
  }
}

CurveNet read_inner_curve(RecipeObject& object, const std::string& field, std::vector<std::string>& notes) {
  constexpr const char* what = "a curve {degree, knots, points} or {degree, knots, homogeneous}";
  RecipeObject curve = object.object(field, what);
  if (curve.has("kind") || curve.has("recipes"))
    object.fail(field, "is a recipe of its own; it should be " + std::string(what) + ", recipes do not nest");
  const int degree = curve.integer("degree", 0, max_degree);
  GivenColumns given = read_columns(curve, false, notes);
  Knots<double> knots = read_knots(curve, "knots", degree, given.columns.rows(), curve.flag_or("closed", false), notes);
  curve.finish();
  return {std::move(knots), std::move(given.columns), given.coordinates};
}

void set_surface(Recipe& recipe, SplineNet net) {
  recipe.shape = RecipeSurface{net.surface, net.columns, net.coordinates, std::move(net), ""};
}

void set_curve(Recipe& recipe, CurveNet net) {
  auto curve = std::make_shared<const SplineCurve>(net.knots);
  recipe.shape = RecipeCurve{std::move(curve), net.columns, net.coordinates, std::move(net), ""};
}

}  // namespace sublimit
