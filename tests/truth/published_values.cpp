// SPDX-License-Identifier: Apache-2.0
#include "truth/published_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "laws/local_types.h"
#include "meshes/meshes.h"
#include "sublimit/limit/detail/limit_masks.h"
#include "sublimit/scheme/refine.h"
#include "support/tolerance.h"
#include "truth/averaging_blocks.h"

namespace sublimit::testing {
namespace {

/// Of repeated averaging, by its steps: two averages in a row are one step that keeps the connectivity.
int averaging_degree(const Scheme<double>& scheme) {
  const auto twice = std::count_if(scheme.steps.begin(), scheme.steps.end(),
                                   [](const Step<double>& step) { return step.split == Split::keep; });
  return 1 + 2 * int(twice) + scheme.is_dual();
}

/// The uniform B-spline at x >= 0: sum of (-1)^j C(d+1, j) ((d+1)/2 - x - j)_+^d / d!.
double bspline(int degree, double x) {
  double sum = 0, binomial = 1;
  for (int j = 0; (degree + 1) / 2.0 - x > j; ++j) {
    sum += (j % 2 ? -1 : 1) * binomial * std::pow((degree + 1) / 2.0 - x - j, degree);
    binomial = binomial * (degree + 1 - j) / (j + 1);
  }
  return sum / std::tgamma(degree + 1);
}

/// Of valences 3 to 12, in eight decimals.
using Table = double[10];
constexpr Table butterfly_lambda = {.25,       .46904152,  .50667561, .5,         .48191070,
                                    .46241777, .444429356, .42859991, .414874008, .402997869};
constexpr Table kobbelt_lambda = {.42633091, .5,        .53794386, .55968452, .57319704,
                                  .58213430, .58833903, .59281631, .59615014, .59869791};

/// The rules along borders: uniform cubic and quadratic B-splines.
constexpr double cubic = 4.0 / 6, quadratic = 1.0 / 2;

PublishedValues averaging_values(int degree, bool dual, int n) {
  PublishedValues values{.centre = averaging_limit(degree, n),
                         .border = bspline(degree, dual ? 0.5 : 0),
                         .lambda = averaging_lambda(degree, n),
                         .lambda_accuracy = other_route};
  if (degree > 6) values.largest = 6;  // closed sets of four rings: seconds of work at larger ones
  return values;
}

}  // namespace

std::optional<PublishedValues> published_values(const Scheme<double>& scheme, int n) {
  const std::string& name = scheme.name;
  const double c = std::cos(2 * std::numbers::pi / n), a = 3.0 / 8 + c / 4, b = (4 - 2 * c) / 9;
  const double catmull_clark = (5 + c + std::sqrt((c + 1) * (c + 9))) / 16;
  const bool cubics = scheme.claims.reproduces >= 3;  // of the interpolating ones: tension 1, which tables are about
  const auto values = [](double centre, double border, std::optional<double> lambda, double accuracy = other_route) {
    return PublishedValues{.centre = centre, .border = border, .lambda = lambda, .lambda_accuracy = accuracy};
  };
  const auto table = [&](const Table& of_tension_1) {
    return cubics ? values(1, 1, of_tension_1[n - 3], eight_decimals) : values(1, 1, std::nullopt);
  };
  if (name == "bilinear") return values(1, 1, 0.5);
  if (name == "catmull-clark" || name == "catmull-clark-intervals") return values(n / (n + 5.0), cubic, catmull_clark);
  if (name == "loop") return values(3 / (3 + 8 * (5.0 / 8 - a * a)), cubic, a);
  if (name == "loop-warren") return values(3 / (3 + 8 * (n == 3 ? 9.0 / 16 : 3.0 / 8)), cubic, a);
  if (name == "doo-sabin" || name == "mid-edge-habib-warren") return values(1.0 / n, quadratic, 0.5);
  if (name == "doo-sabin-averaging" || name == "doo-sabin-intervals")
    return values(1.0 / n, quadratic, n == 3 ? 3.0 / 8 : 0.5 + c / 4);
  if (name == "mid-edge") return values(1.0 / n, quadratic, (1 + c) / 2);
  if (name == "averaging") return averaging_values(averaging_degree(scheme), scheme.is_dual(), n);
  if (name == "sqrt3") return values(1 / (1 + 3 * b), cubic, 2.0 / 9 * (1 + c));
  if (name == "interpolatory-sqrt3") return values(1, 1, 2.0 / 9 * (1 + c));
  if (name == "modified-butterfly") return values(1, 1, 0.5);
  if (name == "butterfly") return table(butterfly_lambda);
  if (name == "kobbelt") return table(kobbelt_lambda);
  return std::nullopt;
}

std::string published_values_hold(const Scheme<double>& scheme) {
  const auto differ = [](double a, double b) { return !(std::abs(a - b) <= other_route); };
  for (int n = 3, largest = 12; n <= largest; ++n) {
    const std::optional<PublishedValues> published = published_values(scheme, n);
    if (!published) return "published_values.cpp has none of " + scheme.name;
    largest = published->largest;
    const auto of_valence = [&](const std::string& what, double is, double should) {
      return what + " of valence " + std::to_string(n) + " is " + std::to_string(is) + ", not " +
             std::to_string(should);
    };
    const std::optional<IsolatedLimit> smooth = isolated_limit(scheme, smooth_type(scheme, n));
    if (!smooth) return "no limit at valence " + std::to_string(n);
    const LimitMasks& masks = smooth->masks;
    if (differ(masks.position[0], published->centre))
      return of_valence("limit weight", masks.position[0], published->centre);
    if (const double lambda = masks.sides.at(0).lambda1;
        published->lambda && !(std::abs(lambda - *published->lambda) <= published->lambda_accuracy))
      return of_valence("subdominant eigenvalue", lambda, *published->lambda);
    for (const LocalType& type : border_types(scheme, n - 1)) {
      // Where a limit is another centre's: of dual schemes at vertices, and in odd levels of sqrt3, whose border
      // vertices have other faces there.
      if ((type.kind == Centre::Kind::vertex) == scheme.is_dual() || type.phase != 0) continue;
      const std::optional<IsolatedLimit> border = isolated_limit(scheme, type);
      const double should = type.corner ? 1 : published->border;
      const std::string at =
          std::string(type.corner ? "corner" : "border vertex") + " of " + std::to_string(n - 1) + " faces";
      if (!border) return "no limit at a " + at;
      if (differ(border->masks.position[0], should))
        return of_valence("limit weight of a " + at, border->masks.position[0], should);
    }
  }
  if (scheme.name == "catmull-clark" || scheme.name == "bilinear") {
    // The face point is the centroid: a pentagon's first row of weights.
    const Level level = refine(scheme, jittered(prism(5)), 1)[1];
    for (Index r = 0; r < level.S.rows(); ++r) {
      if (level.steps[0].origin(Vertex{r}) != Refinement::Origin::face) continue;
      const Eigen::VectorXd row = level.S.row(r).transpose();
      if (differ(row.maxCoeff(), 1.0 / double(level.S.row(r).nonZeros()))) return "a face point is no centroid";
    }
  }
  return {};
}

}  // namespace sublimit::testing
