// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/constructions/coons.h"
#include "sublimit/patches/constructions/gordon.h"
#include "sublimit/patches/constructions/gregory_patch.h"
#include "sublimit/patches/constructions/hermite.h"
#include "sublimit/stencils/recipes/detail/recipe_readers.h"

namespace sublimit {
namespace {

/// -1 if none is given.
double read_tolerance(RecipeObject& object) {
  if (!object.has("tolerance")) return -1;
  const double tolerance = object.number("tolerance").value;
  if (!(tolerance >= 0)) object.fail("tolerance", "is " + format_number(tolerance) + "; it should be 0 or more");
  return tolerance;
}

void read_hermite_surface(RecipeObject& object, Recipe& recipe) {
  const auto vectors = static_cast<HermiteVectors>(object.word("vectors", hermite_vectors_names));
  std::vector<const char*> fields{"p", "pu", "pv"};
  if (vectors == HermiteVectors::sixteen) {
    fields.push_back("puv");
  } else if (object.has("puv")) {
    object.fail("puv", std::string("comes with vectors \"") + hermite_vectors_names[int(vectors)] +
                           "\", which has twists of its own; \"16\" takes them");
  }
  Points data(4 * std::ssize(fields), 3);
  for (size_t i = 0; i < fields.size(); ++i)
    data.middleRows(4 * Eigen::Index(i), 4) = object.space_points(fields[i], 4);
  set_surface(recipe, hermite_patch(vectors, data));
}

CoonsBoundary read_boundary(RecipeObject& object, size_t first, std::vector<std::string>& notes) {
  const auto curve = [&](size_t i) { return read_inner_curve(object, coons_names[first + i], notes); };
  return {curve(0), curve(1), curve(2), curve(3)};
}

void note_gap(const CoonsBoundary& curves, std::vector<std::string>& notes) {
  if (const CornerGap gap = boundary_gap(curves); gap.distance > 0)
    notes.push_back("corners are averaged: the ends of " + gap.curves + " are " + format_number(gap.distance) +
                    " apart at " + gap.corner);
}

template <CoonsBlending blending>
void read_coons(RecipeObject& object, Recipe& recipe) {
  const CoonsBoundary curves = read_boundary(object, 0, recipe.notes);
  set_surface(recipe, coons(curves, blending, read_tolerance(object)));
  note_gap(curves, recipe.notes);
}

void read_general_coons(RecipeObject& object, Recipe& recipe) {
  const CoonsBoundary curves = read_boundary(object, 0, recipe.notes), fields = read_boundary(object, 4, recipe.notes);
  const Points twists = object.space_points("twists", 4);
  set_surface(recipe, general_coons(curves, fields, twists, read_tolerance(object)));
  note_gap(curves, recipe.notes);
}

void read_gregory(RecipeObject& object, Recipe& recipe) {
  const CoonsBoundary curves = read_boundary(object, 0, recipe.notes), fields = read_boundary(object, 4, recipe.notes);
  if (object.has("twists")) {
    object.space_points("twists", 4);
    recipe.notes.push_back("twists: not used; those of this kind follow from the fields xv0, xv1, xu0, xu1");
  }
  const double tolerance = read_tolerance(object);
  GregoryNet patch = gregory_patch(curves, fields, tolerance);
  note_gap(curves, recipe.notes);
  std::string corners;
  for (size_t i = 0; i < 4; ++i)
    if (patch.patch->blended()[i]) corners += (corners.empty() ? "" : ", ") + std::string(coons_corners[i]);
  if (corners.empty()) {  // then it is a general Coons patch
    const CheckedCoons checked = checked_coons(curves, fields, tolerance);
    set_surface(recipe, built(general_coons_builder(checked.knots()),
                              checked.data((checked.twists_of_xu + checked.twists_of_xv) / 2), Coordinates::plain));
    return;
  }
  recipe.shape = RecipeSurface{std::move(patch.patch), std::move(patch.columns), Coordinates::plain, std::nullopt,
                               "twists disagree at " + corners + ": it is rational in u and v there, no B-spline"};
}

void read_gordon(RecipeObject& object, Recipe& recipe) {
  GordonNetwork network;
  const auto read = [&](const char* field, std::vector<CurveNet>& curves) {
    constexpr const char* what = "a list of curves {degree, knots, points}";
    const size_t count = object.objects(field, what).size();
    for (size_t i = 0; i < count; ++i) {
      RecipeObject one = object.objects(field, what)[i];
      const int degree = one.integer("degree", 0, max_degree);
      Points points = one.space_points("points");
      Knots<double> knots = read_knots(one, "knots", degree, points.rows(), false, recipe.notes);
      one.finish();
      curves.push_back({std::move(knots), std::move(points)});
    }
  };
  read("curves_u", network.curves_u);
  read("curves_v", network.curves_v);
  network.parameters_u = object.numbers("parameters_u");
  network.parameters_v = object.numbers("parameters_v");
  const auto blending = static_cast<GordonBlending>(object.word_or("blending", gordon_blending_words, 1));
  set_surface(recipe, gordon(network, blending, read_tolerance(object)));
}

constexpr RecipeKind kinds_of_blends[] = {
    {"hermite_surface", read_hermite_surface},
    {"coons_bilinear", read_coons<CoonsBlending::bilinear>},
    {"coons_bicubic", read_coons<CoonsBlending::bicubic>},
    {"coons_general", read_general_coons},
    {"gregory", read_gregory},
    {"gordon", read_gordon},
};

}  // namespace

std::span<const RecipeKind> blended_kinds() { return kinds_of_blends; }

}  // namespace sublimit
