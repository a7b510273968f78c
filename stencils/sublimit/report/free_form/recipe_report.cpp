// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/free_form/recipe_report.h"

#include <algorithm>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/certificates/c1/exact_joins.h"
#include "sublimit/report/free_form/exact_net.h"
#include "sublimit/stencils/recipes/detail/net_file.h"

namespace sublimit {
namespace {

double value_in(const ExactNumber& x, double) { return x.value; }
/// A fraction as it is written, of another number the double.
Rational value_in(const ExactNumber& x, const Rational&) {
  if (x.denominator == 0) return Rational(x.value);
  return Rational(static_cast<long>(x.numerator), static_cast<long>(x.denominator));
}

/// Columns (x, y, z) or (w x, w y, w z, w): z is 0 in the plane.
template <class T>
std::vector<T> space_columns(const JoinSide& side) {
  std::vector<T> columns;
  for (const std::vector<ExactNumber>& row : side.points) {
    const size_t given = row.size() - (side.homogeneous ? 1 : 0);
    for (size_t k = 0; k < 3; ++k) columns.push_back(k < given ? value_in(row[k], T(0)) : T(0));
    if (side.homogeneous) columns.push_back(value_in(row.back(), T(0)));
  }
  return columns;
}

Coordinates coordinates_of(const JoinSide& side) {
  return side.homogeneous ? Coordinates::homogeneous : Coordinates::plain;
}

template <class T>
BezierPiece<T> join_piece(const JoinSide& side) {
  return {.degree = side.degree[0],
          .columns = space_columns<T>(side),
          .coordinates = coordinates_of(side),
          .length = value_in(side.length, T(0))};
}

BezierPatch<Rational> join_patch(const JoinSide& side) {
  return {.degree_u = side.degree[0],
          .degree_v = side.degree[1],
          .columns = space_columns<Rational>(side),
          .coordinates = coordinates_of(side),
          .length = value_in(side.length, Rational(0))};
}

FreeFormDirection join_direction(int degree, double length) {
  FreeFormDirection result;
  result.degree = degree;
  result.count = degree + 1;
  result.parameters = {0, length};
  result.first = 0, result.last = length;
  return result;
}

/// Adds the shapes of joins behind those that are there.
class JoinShapes {
 public:
  explicit JoinShapes(FreeForm& shapes) : shapes_(shapes), points_(shapes.vertices.rows()) {}

  void add_curve(const JoinSide& side) {
    FreeFormCurve curve;
    start(curve, side);
    curve.u = join_direction(side.degree[0], side.length.value);
    shapes_.curves.push_back(std::move(curve));
  }
  void add_surface(const JoinSide& side) {
    FreeFormSurface surface;
    start(surface, side);
    surface.u = join_direction(side.degree[0], side.length.value);
    surface.v = join_direction(side.degree[1], 1);
    shapes_.surfaces.push_back(std::move(surface));
  }
  void finish() {
    shapes_.vertices.conservativeResize(points_ + std::ssize(rows_), 3);
    for (size_t i = 0; i < rows_.size(); ++i) shapes_.vertices.row(points_ + Eigen::Index(i)) = rows_[i];
  }

 private:
  void start(FreeFormElement& element, const JoinSide& side) {
    element.basis = FreeFormBasis::bezier;
    element.rational = side.homogeneous;
    const std::vector<double> columns = space_columns<double>(side);
    const size_t width = side.homogeneous ? 4 : 3;
    for (size_t at = 0; at < columns.size(); at += width) {
      const double w = side.homogeneous ? columns[at + 3] : 1;
      element.points.push_back(static_cast<Index>(points_ + std::ssize(rows_)));
      rows_.push_back(Eigen::RowVector3d(columns[at], columns[at + 1], columns[at + 2]) / (w == 0 ? 1 : w));
      shapes_.weights.push_back(w);
    }
  }

  FreeForm& shapes_;
  Eigen::Index points_;
  std::vector<Eigen::RowVector3d> rows_;
};

/// One warning for each reason.
std::vector<FreeFormWarning> warnings_of(const std::vector<RecipeNets::LeftOut>& left_out) {
  std::vector<FreeFormWarning> result;
  for (const auto& [recipe, why] : left_out) {
    const char* const rows = recipe->surface() || recipe->curve() ? "rows and no exact net" : "no exact net";
    const std::string says = std::string(rows) + ", so that its joins are not looked for: " + why;
    const auto found = std::ranges::find(result, says, &FreeFormWarning::says);
    if (found != result.end()) {
      ++found->count;
      continue;
    }
    FreeFormWarning& warning = result.emplace_back();
    warning.severity = AssetWarning::Severity::warning;
    warning.says = says;
    warning.advice = "`sublimit construct` lists the kinds that have one";
    warning.recipe = label(*recipe);
  }
  return result;
}

}  // namespace

FreeFormReport recipe_report(const std::vector<Recipe>& recipes, const std::string& name,
                             const FreeFormReportOptions& options) {
  RecipeNets nets = recipe_nets(recipes);
  std::erase_if(nets.left_out, [](const RecipeNets::LeftOut& one) { return one.recipe->join() != nullptr; });
  std::vector<std::string> surface_recipes, curve_recipes;
  for (const Recipe* const recipe : nets.surface) surface_recipes.push_back(label(*recipe));
  for (const Recipe* const recipe : nets.curve) curve_recipes.push_back(label(*recipe));
  GivenJoins joins;
  JoinShapes shapes(nets.shapes);
  for (const Recipe& recipe : recipes) {
    if (!recipe.join()) continue;
    const auto& [left, right] = *recipe.join();
    const bool is_surface = left.degree.size() == 2;
    try {
      if (is_surface) {
        joins.surfaces.push_back({exact_surface_join(join_patch(left), join_patch(right)), label(recipe)});
      } else {
        joins.curves.push_back({join_piece<double>(left), join_piece<double>(right), join_piece<Rational>(left),
                                join_piece<Rational>(right), label(recipe)});
        (void)curve_join(joins.curves.back().left, joins.curves.back().right);  // whether it can be decided
      }
    } catch (const InvalidParameter& error) {
      throw FormatError(recipe.place + ": " + error.what());
    }
    for (const JoinSide* const side : {&left, &right}) {
      is_surface ? shapes.add_surface(*side) : shapes.add_curve(*side);
      (is_surface ? surface_recipes : curve_recipes).push_back(label(recipe));
    }
  }
  shapes.finish();
  if (surface_recipes.empty() && curve_recipes.empty())
    throw UnsupportedTopology(label(*nets.left_out[0].recipe) +
                              ": no exact net, so that there are no joins to analyse: " + nets.left_out[0].why);
  ExactShapes exact;
  for (const Recipe* const recipe : nets.surface) exact.surfaces.push_back(exact_net(*recipe));
  for (const Recipe* const recipe : nets.curve) exact.curves.push_back(exact_pieces(*recipe));
  FreeFormReport report = free_form_report(std::move(nets.shapes), name, options, joins, &exact);
  report.surface_recipes = std::move(surface_recipes);
  report.curve_recipes = std::move(curve_recipes);
  for (FreeFormWarning& warning : warnings_of(nets.left_out)) report.warnings.push_back(std::move(warning));
  std::ranges::stable_sort(report.warnings, {}, &FreeFormWarning::severity);
  return report;
}

}  // namespace sublimit
