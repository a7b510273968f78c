// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/constructions/graph.h"
#include "sublimit/patches/constructions/lagrange_curve.h"
#include "sublimit/patches/constructions/lagrange_surface.h"
#include "sublimit/patches/constructions/triangle_patch.h"
#include "sublimit/stencils/recipes/detail/recipe_readers.h"

namespace sublimit {
namespace {

void expect_grid(const RecipeObject& object, const char* field, Eigen::Index count, std::int64_t m, std::int64_t n,
                 const std::string& why) {
  if (count != m * n)
    object.fail(field, "has " + format_number(count) + " entries; " + why + " needs " + format_number(m) + " x " +
                           format_number(n));
}

const char* columns_field(const GivenColumns& given) {
  return given.coordinates == Coordinates::plain ? "points" : "homogeneous";
}

void read_bezier_surface(RecipeObject& object, Recipe& recipe) {
  const std::vector<int> degree = object.integers("degree", 2, 0, max_degree);
  GivenColumns given = read_columns(object, false, recipe.notes);
  expect_grid(object, columns_field(given), given.columns.rows(), degree[0] + 1, degree[1] + 1,
              "degree [" + format_number(degree[0]) + ", " + format_number(degree[1]) + "]");
  set_surface(recipe, spline_net(bezier_knots<double>(degree[0]), bezier_knots<double>(degree[1]),
                                 std::move(given.columns), given.coordinates));
}

void read_bezier_triangle(RecipeObject& object, Recipe& recipe) {
  const int degree = object.integer("degree", 1, max_degree);
  GivenColumns given = read_columns(object, false, recipe.notes);
  auto patch = std::make_shared<const TrianglePatch>(degree);
  if (given.columns.rows() != patch->num_points())
    object.fail(columns_field(given), "has " + format_number(given.columns.rows()) + " points; degree " +
                                          format_number(degree) + " needs " + format_number(patch->num_points()));
  recipe.shape = RecipeSurface{std::move(patch), std::move(given.columns), given.coordinates, std::nullopt,
                               "it is a triangle, and nets of free-form OBJ files are grids"};
}

/// Knots in both directions for control points in a grid of a shape.
std::pair<Knots<double>, Knots<double>> read_both_knots(RecipeObject& object, const std::vector<int>& shape,
                                                        std::vector<std::string>& notes) {
  const std::vector<int> degree = object.integers("degree", 2, 0, max_degree);
  const std::vector<bool> closed = object.flags_or("closed", 2, false);
  return {read_knots(object, "knots_u", degree[0], shape[0], closed[0], notes),
          read_knots(object, "knots_v", degree[1], shape[1], closed[1], notes)};
}

void read_bspline_surface(RecipeObject& object, Recipe& recipe) {
  const std::vector<int> shape = object.integers("shape", 2, 1, 1 << 30);
  GivenColumns given = read_columns(object, false, recipe.notes);
  expect_grid(object, columns_field(given), given.columns.rows(), shape[0], shape[1], "the shape");
  const auto [u, v] = read_both_knots(object, shape, recipe.notes);
  set_surface(recipe, spline_net(u, v, std::move(given.columns), given.coordinates));
}

void read_functional_surface(RecipeObject& object, Recipe& recipe) {
  const std::vector<int> degree = object.integers("degree", 2, 0, max_degree);
  const std::vector<double> values = object.numbers("values");
  // The shape follows from the knots: full ones, or without the first and the last where that fits the values.
  const auto count = [&](const char* field, int p) { return std::ssize(object.numbers(field)) - p - 1; };
  const std::int64_t m = count("knots_u", degree[0]), n = count("knots_v", degree[1]), size = std::ssize(values);
  const auto fits = [&](int more_u, int more_v) {
    return m + more_u > 0 && n + more_v > 0 && (m + more_u) * (n + more_v) == size;
  };
  const int more_u = fits(0, 0) || fits(0, 2) ? 0 : fits(2, 2) || fits(2, 0) ? 2 : 0;
  const int more_v = fits(more_u, 0) ? 0 : fits(more_u, 2) ? 2 : 0;
  if (!fits(more_u, more_v))
    object.fail("values", "has " + format_number(size) + " numbers; the knots need " + format_number(m) + " x " +
                              format_number(n));
  set_surface(recipe, functional_surface(read_knots(object, "knots_u", degree[0], m + more_u, false, recipe.notes),
                                         read_knots(object, "knots_v", degree[1], n + more_v, false, recipe.notes),
                                         Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(size))));
}

LagrangeBasis read_basis(RecipeObject& object, const char* field) {
  try {
    return LagrangeBasis(object.numbers(field));
  } catch (const InvalidParameter& error) {
    object.fail(field, error.what());
  }
}

void read_lagrange_surface(RecipeObject& object, Recipe& recipe) {
  const LagrangeBasis u = read_basis(object, "nodes_u"), v = read_basis(object, "nodes_v");
  Points points = object.space_points("points");
  expect_grid(object, "points", points.rows(), u.size(), v.size(), "the grid of the nodes");
  const Index degree = std::max(u.size(), v.size()) - 1;
  if (degree > wild_lagrange_degree)
    recipe.notes.push_back("degree " + format_number(degree) +
                           ": polynomials through many points can oscillate between them; splines do not");
  std::optional<SplineNet> net = lagrange_net(u, v, points);
  recipe.shape = RecipeSurface{std::make_shared<const LagrangeSurface>(u, v), std::move(points), Coordinates::plain,
                               std::move(net), "its degree is too high for control points that are exact to rounding"};
}

constexpr RecipeKind kinds_of_grids[] = {
    {"bezier_surface", read_bezier_surface},         {"bezier_triangle", read_bezier_triangle},
    {"bspline_surface", read_bspline_surface},       {"nurbs_surface", read_bspline_surface},
    {"functional_surface", read_functional_surface}, {"lagrange_surface", read_lagrange_surface},
};

}  // namespace

std::span<const RecipeKind> grid_kinds() { return kinds_of_grids; }

}  // namespace sublimit
