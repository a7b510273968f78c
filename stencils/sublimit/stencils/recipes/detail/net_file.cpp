// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/recipes/detail/net_file.h"

#include <algorithm>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/free_form_counts.h"

namespace sublimit {
namespace {

bool is_one_piece(const Knots<double>& knots) {
  const std::span<const double> all = knots.all();
  return knots.num_faces() == 1 && std::ssize(all) == 2 * knots.degree() + 2 && all.front() == knots.begin() &&
         all.back() == knots.end();
}

/// Why there is none.
struct NoNet {
  std::string why;
};

class NetWriter {
 public:
  FreeForm take() {
    FreeForm result = std::move(shapes_);
    result.vertices.resize(std::ssize(points_), 3);
    for (size_t i = 0; i < points_.size(); ++i) result.vertices.row(Eigen::Index(i)) = points_[i];
    return result;
  }

  /// @throws NoNet
  void add(const Recipe& recipe) {
    if (const RecipeCurve* const curve = recipe.curve()) {
      if (!curve->net) refuse(curve->no_net);
      const CurveNet& net = *curve->net;
      FreeFormCurve element;
      start(element, recipe, net.coordinates, is_one_piece(net.knots));
      element.u = direction(net.knots, element.basis, "t");
      const Index first = add_points(net.columns, net.coordinates);
      for (Index i = 0; i < net.knots.num_functions(); ++i) element.points.push_back(first + net.knots.point(i));
      shapes_.curves.push_back(std::move(element));
    } else if (const RecipeSurface* const surface = recipe.surface()) {
      if (!surface->net) refuse(surface->no_net);
      const SplineNet& net = *surface->net;
      const Knots<double>&u = net.surface->u(), &v = net.surface->v();
      FreeFormSurface element;
      start(element, recipe, net.coordinates, is_one_piece(u) && is_one_piece(v));
      element.u = direction(u, element.basis, "u");
      element.v = direction(v, element.basis, "v");
      const Index first = add_points(net.columns, net.coordinates);
      for (Index j = 0; j < v.num_functions(); ++j)
        for (Index i = 0; i < u.num_functions(); ++i)
          element.points.push_back(first + u.point(i) + u.num_points() * v.point(j));
      shapes_.surfaces.push_back(std::move(element));
    } else {
      refuse("this kind is no B-spline curve or surface");
    }
  }

 private:
  [[noreturn]] static void refuse(const std::string& why) { throw NoNet{why}; }

  Index name(const std::string& word) {
    const auto found = std::ranges::find(shapes_.names, word);
    if (found == shapes_.names.end()) {
      shapes_.names.push_back(word);
      return static_cast<Index>(shapes_.names.size()) - 1;
    }
    return static_cast<Index>(found - shapes_.names.begin());
  }

  void start(FreeFormElement& element, const Recipe& recipe, Coordinates coordinates, bool one_piece) {
    element.basis = one_piece ? FreeFormBasis::bezier : FreeFormBasis::bspline;
    element.rational = coordinates == Coordinates::homogeneous;
    if (!recipe.name.empty()) element.object = name(recipe.name);
    if (!recipe.group.empty()) element.group = name(recipe.group);
  }

  static FreeFormDirection direction(const Knots<double>& knots, FreeFormBasis basis, const std::string& parameter) {
    if (knots.degree() < 1) refuse("degree 0 in " + parameter + ", which OBJ does not have");
    FreeFormDirection result;
    result.degree = knots.degree();
    result.count = knots.num_functions();
    result.first = knots.begin(), result.last = knots.end();
    if (basis == FreeFormBasis::bezier) {
      result.parameters = {knots.begin(), knots.end()};
      return result;
    }
    result.parameters.assign(knots.all().begin(), knots.all().end());
    if (const size_t excess = first_excess_knot(result.parameters, knots.degree()); excess < result.parameters.size())
      refuse("it jumps at " + parameter + " = " + format_number(result.parameters[excess]) +
             ", which OBJ does not have");
    return result;
  }

  /// OBJ has points and weights apart; a point of weight 0 stays a direction.
  Index add_points(const Points& columns, Coordinates coordinates) {
    const auto first = static_cast<Index>(points_.size());
    const bool rational = coordinates == Coordinates::homogeneous;
    const Eigen::Index dimension = columns.cols() - (rational ? 1 : 0);
    if (dimension > 3) refuse(format_number(dimension) + " coordinates, OBJ has 3");
    for (Eigen::Index i = 0; i < columns.rows(); ++i) {
      const double w = rational ? columns(i, dimension) : 1;
      Eigen::RowVector3d point(0, 0, 0);
      point.head(dimension) = columns.row(i).head(dimension) / (w == 0 ? 1 : w);
      points_.push_back(point);
      shapes_.weights.push_back(w);
    }
    return first;
  }

  FreeForm shapes_;
  std::vector<Eigen::RowVector3d> points_;
};

}  // namespace

RecipeNets recipe_nets(const std::vector<Recipe>& recipes) {
  NetWriter writer;
  RecipeNets result;
  for (const Recipe& recipe : recipes) {
    try {
      writer.add(recipe);
    } catch (const NoNet& none) {
      result.left_out.push_back({&recipe, none.why});
      continue;
    }
    (recipe.surface() ? result.surface : result.curve).push_back(&recipe);
  }
  result.shapes = writer.take();
  return result;
}

FreeForm net_file(const std::vector<Recipe>& recipes) {
  RecipeNets nets = recipe_nets(recipes);
  if (!nets.left_out.empty())
    throw UnsupportedTopology(nets.left_out[0].recipe->place +
                              ": there is no exact net to write: " + nets.left_out[0].why);
  return std::move(nets.shapes);
}

}  // namespace sublimit
