// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/constructions/interpolation.h"
#include "sublimit/patches/constructions/lagrange_curve.h"
#include "sublimit/patches/constructions/polynomial_curves.h"
#include "sublimit/stencils/recipes/detail/recipe_readers.h"

namespace sublimit {
namespace {

constexpr std::size_t most_coordinates = 1000;

std::pair<double, double> read_domain(RecipeObject& object) {
  if (!object.has("domain")) return {0, 1};
  const std::vector<double> domain = object.numbers("domain", 2);
  if (!(domain[0] < domain[1]))
    object.fail("domain", "is " + format_number(domain[0]) + " to " + format_number(domain[1]) + "; it must rise");
  return {domain[0], domain[1]};
}

void expect_count(const RecipeObject& object, const char* field, Eigen::Index count, Eigen::Index wanted,
                  const std::string& why) {
  if (count != wanted)
    object.fail(field, "has " + format_number(count) + " points; " + why + " needs " + format_number(wanted));
}

void read_bezier_curve(RecipeObject& object, Recipe& recipe) {
  const int degree = object.integer("degree", 0, max_degree);
  GivenColumns given = read_columns(object, true, recipe.notes);
  expect_count(object, given.coordinates == Coordinates::plain ? "points" : "homogeneous", given.columns.rows(),
               degree + 1, "degree " + format_number(degree));
  const auto [begin, end] = read_domain(object);
  set_curve(recipe, bezier_curve(std::move(given.columns), begin, end, given.coordinates));
}

/// How the matrix of a basis is written: a row of coefficients for each control point, 1 first, as OBJ's `bmat` has it;
/// or M of (t^n .. t 1) M (P_0 .. P_n)^T, as textbooks do.
constexpr const char* matrix_forms[] = {"obj", "textbook"};

/// Functions of a curve that is made of points sum to 1.
bool is_partition(const Points& by_point) {
  const Eigen::RowVectorXd sums = by_point.colwise().sum();
  const double rounding = 1e-12 * by_point.cwiseAbs().maxCoeff() * static_cast<double>(by_point.rows());
  return std::abs(sums[0] - 1) <= rounding && sums.tail(sums.size() - 1).cwiseAbs().maxCoeff() <= rounding;
}

/// By rows of control points.
Points basis_matrix(RecipeObject& object, const Points& given) {
  const Points textbook = given.colwise().reverse().transpose();
  if (object.has("form")) return object.word("form", matrix_forms) == 0 ? given : textbook;
  // Vectors among the points, as of Hermite curves, sum to anything: then no form is more likely than the other.
  if (!is_partition(given) && is_partition(textbook))
    object.fail(
        "matrix",
        "is M of (t^n .. t 1) M P, as textbooks write it; a row for each control point with the coefficients of "
        "1, t, t^2 .. is expected, as OBJ's bmat has it; add \"form\": \"textbook\", or \"obj\" if it is meant so");
  return given;
}

void read_bmatrix_curve(RecipeObject& object, Recipe& recipe) {
  const int degree = object.integer("degree", 1, max_degree), order = degree + 1;
  MatrixCurve curve;
  const Points matrix = object.points("matrix", size_t(order), size_t(order));
  if (matrix.rows() != order)
    object.fail("matrix", "has " + format_number(matrix.rows()) + " rows; degree " + format_number(degree) + " needs " +
                              format_number(order));
  curve.matrix = basis_matrix(object, matrix);
  curve.step = object.integer("step", 1, 1000000);
  curve.points = object.points("points", 1, most_coordinates);
  if (object.has("parm")) curve.ends = object.numbers("parm");
  set_curve(recipe, matrix_curve(curve));
}

void read_taylor_curve(RecipeObject& object, Recipe& recipe) {
  const Points coefficients = object.points("points", 1, most_coordinates);
  const auto [begin, end] = read_domain(object);
  set_curve(recipe, taylor_curve(coefficients, begin, end));
}

void read_lagrange_curve(RecipeObject& object, Recipe& recipe) {
  LagrangeBasis basis(object.numbers("nodes"));
  Points points = object.points("points", 1, most_coordinates);
  expect_count(object, "points", points.rows(), basis.size(), format_number(basis.size()) + " nodes");
  if (basis.size() - 1 > wild_lagrange_degree)
    recipe.notes.push_back("degree " + format_number(basis.size() - 1) +
                           ": polynomials through many points can oscillate between them; splines do not");
  std::optional<CurveNet> net = lagrange_net(basis, points);
  recipe.shape =
      RecipeCurve{std::make_shared<const LagrangeCurve>(std::move(basis)), std::move(points), Coordinates::plain,
                  std::move(net), "its degree is too high for control points that are exact to rounding"};
}

void read_hermite_curve(RecipeObject& object, Recipe& recipe) {
  const Points points = object.points("points", 1, most_coordinates),
               tangents = object.points("tangents", size_t(points.cols()), size_t(points.cols()));
  expect_count(object, "points", points.rows(), 2, "a Hermite curve");
  expect_count(object, "tangents", tangents.rows(), 2, "a Hermite curve");
  set_curve(recipe, hermite_curve(points, tangents));
}

void read_bspline_curve(RecipeObject& object, Recipe& recipe) {
  const int degree = object.integer("degree", 0, max_degree);
  GivenColumns given = read_columns(object, true, recipe.notes);
  Knots<double> knots =
      read_knots(object, "knots", degree, given.columns.rows(), object.flag_or("closed", false), recipe.notes);
  set_curve(recipe, {std::move(knots), std::move(given.columns), given.coordinates});
}

void read_interpolating_bspline(RecipeObject& object, Recipe& recipe) {
  const int degree = object.integer("degree", 0, max_degree);
  const std::vector<double> parameters = object.numbers("parameters");
  const Points points = object.points("points", 1, most_coordinates);
  expect_count(object, "points", points.rows(), std::ssize(parameters),
               format_number(parameters.size()) + " parameters");
  const Knots<double> knots = object.has("knots")
                                  ? read_knots(object, "knots", degree, points.rows(), false, recipe.notes)
                                  : averaged_knots(degree, parameters);
  set_curve(recipe, {knots, interpolating_points(knots, parameters, points)});
}

void read_interpolating_cubic(RecipeObject& object, Recipe& recipe) {
  const auto ends = static_cast<CubicEnds>(object.word("ends", cubic_ends_words));
  const std::vector<double> parameters = object.numbers("parameters");
  const Points points = object.points("points", 1, most_coordinates);
  Points derivatives;
  if (object.has("end_derivatives"))
    derivatives = object.points("end_derivatives", size_t(points.cols()), size_t(points.cols()));
  set_curve(recipe, interpolating_cubic(ends, parameters, points, derivatives));
}

constexpr RecipeKind kinds_of_curves[] = {
    {"bezier_curve", read_bezier_curve},
    {"bmatrix_curve", read_bmatrix_curve},
    {"taylor_curve", read_taylor_curve},
    {"lagrange_curve", read_lagrange_curve},
    {"hermite_curve", read_hermite_curve},
    {"bspline_curve", read_bspline_curve},
    {"nurbs_curve", read_bspline_curve},
    {"interpolate_bspline", read_interpolating_bspline},
    {"interpolate_cubic", read_interpolating_cubic},
};

}  // namespace

std::span<const RecipeKind> curve_kinds() { return kinds_of_curves; }

}  // namespace sublimit
