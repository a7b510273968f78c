// SPDX-License-Identifier: Apache-2.0
#include "laws/curve_laws.h"

#include <cmath>
#include <random>

#include "laws/point_limits.h"
#include "laws/stationary.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/curves/detail/curve_vertex.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Scheme = CurveScheme<double>;
using Dense = Eigen::MatrixXd;

/// Open and closed curves, short and long.
std::vector<ControlPolygon> polygons_for(const Scheme& scheme) {
  std::vector<ControlPolygon> polygons;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const CurveLayout layout(scheme);
  for (const bool closed : {false, true})
    for (const Index size : {layout.least_points(closed), 7, 8, 60}) {
      if (size < layout.least_points(closed)) continue;
      Points points(size, 2);
      for (double& value : points.reshaped()) value = coordinate(random);
      polygons.push_back(polygon_through(points, closed));
      polygons.back().tangents = points.rowwise().reverse();
    }
  ControlPolygon two = polygon_through(Points::Random(25, 3));
  two.curves = {{{3, 1, 2, 0, 4, 20, 21, 22}, true}, {{5, 6, 7, 8, 9, 10, 11, 12, 3, 13, 14, 15}, false}};
  polygons.push_back(two);
  return polygons;
}

std::string rows_sum_to_one(const Scheme& scheme) {
  for (const ControlPolygon& polygon : polygons_for(scheme))
    for (const CurveLevel& level : refine(scheme, polygon, 3)) {
      const auto ones = [&](Eigen::Index size) {  // points; derivatives are 0
        Eigen::VectorXd one = Eigen::VectorXd::Zero(size);
        for (Eigen::Index i = 0; i < size; i += level.unknowns) one[i] = 1;
        return one;
      };
      const Eigen::VectorXd wrong = level.S * ones(level.S.cols()) - ones(level.S.rows());
      if (wrong.cwiseAbs().maxCoeff() > rounding(16)) return "a row sum is off by " + std::to_string(wrong.maxCoeff());
    }
  return {};
}

std::string counts_follow_the_layout(const Scheme& scheme) {
  for (const ControlPolygon& polygon : polygons_for(scheme)) {
    const std::vector<CurveLevel> levels = refine(scheme, polygon, 3);
    for (size_t k = 1; k < levels.size(); ++k) {
      Index count = 0;
      for (size_t c = 0; c < levels[k].curves.size(); ++c) {
        const CurveOutline &from = levels[k - 1].curves[c], &to = levels[k].curves[c];
        if (to.closed != polygon.curves[c].closed) return "a curve was opened or closed";
        if (to.closed && to.size != 2 * from.size) return "a closed curve does not double its points";
        if (!to.closed && scheme.ends.beyond && to.size != 2 * from.size - (scheme.masks.dual() ? 2 : 1))
          return "an open curve with kept ends has " + std::to_string(to.size) + " points";
        count += to.size;
      }
      if (levels[k].S.rows() != count * levels[k].unknowns) return "S has another number of rows than there are points";
    }
  }
  return {};
}

std::string curves_reversed_stay_themselves(const Scheme& scheme) {
  for (const ControlPolygon& polygon : polygons_for(scheme)) {
    if (polygon.curves.size() != 1) continue;
    const bool closed = polygon.curves[0].closed;
    const CurveLevel level = refine(scheme, polygon, 1)[1];
    const Dense S = level.S;
    const int unknowns = level.unknowns;
    const Index rows = Index(S.rows()) / unknowns, columns = Index(S.cols()) / unknowns;
    const Index turn = closed ? (scheme.masks.dual() ? 3 : 2) : 1;
    for (Index r = 0; r < rows; ++r)
      for (Index c = 0; c < columns; ++c)
        for (int i = 0; i < unknowns; ++i)
          for (int j = 0; j < unknowns; ++j) {  // derivatives change their sign
            const Index other = ((rows - turn - r) % rows + rows) % rows;
            const double mirrored = S(other * unknowns + i, (columns - 1 - c) * unknowns + j) * (i == j ? 1 : -1);
            if (std::abs(S(r * unknowns + i, c * unknowns + j) - mirrored) > rounding(16))
              return "point " + std::to_string(r) + " is not symmetric";
          }
  }
  return {};
}

std::string closed_curves_have_no_first_point(const Scheme& scheme) {
  for (const ControlPolygon& polygon : polygons_for(scheme)) {
    if (polygon.curves.size() != 1 || !polygon.curves[0].closed) continue;
    const CurveLevel level = refine(scheme, polygon, 1)[1];
    const Dense S = level.S;
    const Index rows = Index(S.rows()), columns = Index(S.cols()), unknowns = level.unknowns;
    for (Index r = 0; r < rows; ++r)
      for (Index c = 0; c < columns; ++c)
        if (S((r + 2 * unknowns) % rows, (c + unknowns) % columns) != S(r, c))
          return "a weight changes when the points are counted from another";
  }
  return {};
}

std::string claims_about_weights_hold(const Scheme& scheme) {
  for (const ControlPolygon& polygon : polygons_for(scheme)) {
    const CurveLevel level = refine(scheme, polygon, 1)[1];
    for (Index r = 0; r < level.S.rows(); ++r)
      for (SparseMatrix::InnerIterator it(level.S, r); it; ++it)
        if (scheme.claims.convex_hull && it.value() < 0) return "a weight is negative";
    if (polygon.curves.size() > 1) continue;
    const Index unknowns = level.unknowns;
    for (Index c = 0; c < level.S.cols() && scheme.claims.interpolates; ++c) {
      const Index row = c + c - c % unknowns;  // a derivative is per edge, and edges are half as long
      if (level.S.row(row).nonZeros() != 1 || level.S.coeff(row, c) != (c % unknowns == 0 ? 1 : 0.5))
        return "an old point moves";
    }
    const Index last = Index(level.S.rows()) - 1;
    if (!polygon.curves[0].closed && scheme.ends.beyond &&
        (level.S.coeff(0, 0) != 1 || level.S.coeff(last, level.S.cols() - 1) != 1))
      return "an end moves";
  }
  return {};
}

/// A regular open curve, with its parameters.
struct Line {
  CurveLayout layout;
  CurveOutline outline, child;
  CurveLevel level;
  Eigen::VectorXd x, y;  ///< positions of parents and children in edges of the parents
  explicit Line(const Scheme& scheme, Index size = 40)
      : layout(scheme), outline(layout.control(size, false)), child(layout.child(outline)), x(size), y(child.size) {
    level.unknowns = layout.unknowns();
    level.curves = {outline};
    for (Index a = 0; a < size; ++a) x[a] = double(layout.position(outline, a)) / 2;
    for (Index a = 0; a < child.size; ++a) y[a] = double(layout.position(child, a)) / 4;
  }
};

/// x^degree; of Hermite schemes with its derivatives, per edge of this length.
Eigen::VectorXd power(const Scheme& scheme, const Eigen::VectorXd& x, int degree, double edge = 1) {
  if (scheme.masks.unknowns() == 1) return x.array().pow(degree);
  Eigen::VectorXd both(2 * x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    both[2 * i] = std::pow(x[i], degree);
    both[2 * i + 1] = degree == 0 ? 0 : edge * degree * std::pow(x[i], degree - 1);
  }
  return both;
}

/// Whether points on a polynomial have children on a polynomial with the same leading term: differences of that order
/// are the constant that they should be. (Limits then are polynomials, and only then.)
double generation_defect(const Scheme& scheme, int degree) {
  const Line line(scheme);
  const double centre = line.x[20];
  Eigen::VectorXd values = curve_matrix(scheme, {line.outline}, 0) * power(scheme, line.x.array() - centre, degree);
  if (scheme.masks.unknowns() > 1) {  // differences see no derivatives; old points stay, so that children tell
    const Eigen::VectorXd wrong = values - power(scheme, line.y.array() - centre, degree, 0.5);
    return wrong.segment(wrong.size() / 2 - 12, 24).cwiseAbs().maxCoeff();
  }
  std::vector<double> row;
  for (Index a = 0; a < line.child.size; ++a)
    if (std::abs(line.y[a] - centre) < 5) row.push_back(values[a]);
  double expected = 1;
  for (int i = 1; i <= degree; ++i) expected *= i / 2.0;
  for (int i = 0; i < degree; ++i)
    for (size_t a = 0; a + 1 + i < row.size(); ++a) row[a] = row[a + 1] - row[a];
  double defect = 0;
  for (size_t a = 0; a + degree < row.size(); ++a) defect = std::max(defect, std::abs(row[a] - expected));
  return defect / expected;
}

std::string polynomials_are_generated_up_to_the_claim(const Scheme& scheme) {
  for (int degree = 0; degree <= scheme.claims.generates; ++degree)
    if (const double defect = generation_defect(scheme, degree); defect > 1e-9 * std::pow(4, std::max(0, degree - 5)))
      return "degree " + std::to_string(degree) + " is missed by " + std::to_string(defect);
  if (generation_defect(scheme, scheme.claims.generates + 1) < 1e-5) return "more is generated than claimed";
  return {};
}

double reproduction_defect(const Scheme& scheme, int degree) {
  const Line line(scheme);
  const Index middle = 20;
  const PointLimits limit = limits_at(scheme, line.level, {{middle, 0}});
  // Not around the middle itself, where odd powers vanish.
  const Eigen::VectorXd x = line.x.array() - line.x[middle] + 0.5;
  return std::abs((limit.position * power(scheme, x, degree))[0] - std::pow(0.5, degree));
}

std::string polynomials_are_reproduced_up_to_the_claim(const Scheme& scheme) {
  for (int degree = 0; degree <= scheme.claims.reproduces; ++degree)
    if (reproduction_defect(scheme, degree) > rounding(64, std::pow(6, degree)))
      return "degree " + std::to_string(degree) + " is missed";
  // Where limits interpolate the points, what is generated tells.
  if (!scheme.claims.interpolates && reproduction_defect(scheme, scheme.claims.reproduces + 1) < 1e-6)
    return "more is reproduced than claimed";
  if (scheme.claims.interpolates && scheme.claims.reproduces != scheme.claims.generates) return "claims disagree";
  return {};
}

/// Ends: linear functions go on; points on an odd polynomial about the end see a reflected end as if there were none,
/// points on polynomials up to its degree an extrapolated one.
std::string ends_go_on(const Scheme& scheme) {
  if (!scheme.ends.beyond) return {};
  const Line line(scheme);
  const CurveSite<double> first(0, scheme.ends, scheme.masks.dual(), 0, 40);
  const Stencil<double> second_beyond = scheme.ends.beyond(CurveEnd<double>(first, true), 2);
  const bool reflected = scheme.ends.points == 2 && second_beyond.terms().back() == std::pair<Index, double>(2, -1);
  std::vector<int> degrees;
  for (int degree = 0; degree < scheme.ends.points; ++degree) degrees.push_back(degree);
  if (reflected) degrees = {0, 1, 3, 5};
  const auto& masks = scheme.masks;
  const CurveSite<double> inside(0);
  const Stencil<double> mask[] = {masks.dual() ? masks.before(inside) : masks.point(inside),
                                  masks.dual() ? masks.after(inside) : masks.edge(inside)};
  for (const int degree : degrees) {
    const Eigen::VectorXd values = curve_matrix(scheme, {line.outline}, 0) * power(scheme, line.x, degree);
    for (Index a = 1; a < 12; ++a) {
      const auto [parent, which] = line.layout.source(line.outline, line.child, a);
      double truth = 0;  // of the mask on an endless line of points
      for (const auto& [slot, weight] : mask[which].terms()) truth += weight * std::pow(line.x[parent] + slot, degree);
      if (std::abs(values[a] - truth) > rounding(64, std::pow(8, degree)))
        return "child " + std::to_string(a) + " of points on x^" + std::to_string(degree) + " differs";
    }
  }
  return {};
}

double difference(const SparseMatrix& a, const SparseMatrix& b) { return (Dense(a) - Dense(b)).cwiseAbs().maxCoeff(); }

/// L_k = L_{k+1} S_k, for limits and derivatives.
std::string limits_agree_between_levels(const Scheme& scheme) {
  const CurveLayout layout(scheme);
  for (const ControlPolygon& polygon : polygons_for(scheme)) {
    const std::vector<CurveLevel> levels = refine(scheme, polygon, 2);
    for (int k = 0; k < 2; ++k) {
      if (levels[k].curves.size() > 1) continue;
      const CurveOutline &coarse = levels[k].curves[0], &fine = levels[k + 1].curves[0];
      std::vector<CurvePlace> places, on_fine;
      for (Index a = 0; a < coarse.size; ++a) {
        places.push_back(place_at(layout, coarse, layout.position(coarse, a)));
        on_fine.push_back(place_at(layout, fine, 2 * layout.position(coarse, a)));
      }
      const PointLimits L = limits_at(scheme, levels[k], places), M = limits_at(scheme, levels[k + 1], on_fine);
      const SparseMatrix position = M.position * levels[k + 1].S, first = M.first * levels[k + 1].S,
                         second = M.second * levels[k + 1].S;
      if (difference(L.position, position) > rounding(16)) return "limits of levels " + std::to_string(k) + " differ";
      if (difference(L.first, first) > rounding(256)) return "derivatives of levels " + std::to_string(k) + " differ";
      for (Index a = 0; a < coarse.size; ++a)  // at a knot of the finer level only one-sided ones may exist
        if (L.order[a] == 2 && M.order[a] == 2 &&
            (Dense(L.second).row(a) - Dense(second).row(a)).cwiseAbs().maxCoeff() > rounding(4096))
          return "second derivatives of levels " + std::to_string(k) + " differ";
    }
  }
  return {};
}

std::string derivatives_fit_the_claim(const Scheme& scheme) {
  const Line line(scheme);
  const PointLimits L = point_limits(scheme, line.level);
  const Eigen::VectorXd ones = power(scheme, line.x, 0), x = power(scheme, line.x, 1);
  for (Index a = 0; a < 40; ++a) {
    if (L.order[a] < std::min(scheme.claims.regular, 2)) return "point " + std::to_string(a) + " has no derivative";
    if (L.order[a] > 0 && std::abs((L.first * x)[a] - 1) > rounding(256)) return "the derivative of x is not 1";
    if (L.order[a] > 0 && std::abs((L.first * ones)[a]) > rounding(64)) return "the derivative of 1 is not 0";
    if (L.order[a] > 1 && std::abs((L.second * x)[a]) > 1e-10) return "the second derivative of x is not 0";
  }
  return {};
}

/// What smoothness C^r needs of the local matrix inside: eigenvalues 1, 1/2, ..., 2^-r, and no other as large as the
/// last.
std::string spectrum_fits_the_claim(const Scheme& scheme) {
  const Line line(scheme, 200);
  Eigen::VectorXd moduli = eigenvalues(curve_neighborhood(scheme, line.outline, 0, 200).A).cwiseAbs();
  std::sort(moduli.begin(), moduli.end(), std::greater<>());
  const int r = scheme.claims.regular;
  for (int i = 0; i <= r && is_stationary(scheme); ++i)
    if (std::abs(moduli[i] - std::pow(0.5, i)) > 1e-9)
      return "eigenvalue " + std::to_string(i) + " is " + std::to_string(moduli[i]);
  if (moduli[r + 1] > std::pow(0.5, r) * (r > 0 ? 0.9999 : 1))
    return "an eigenvalue is too large for C^" + std::to_string(r);
  return {};
}

/// Masks as printed, for the schemes whose masks nothing else determines.
std::string published_values_hold(const Scheme& scheme) {
  const Stencil<double> mask = scheme.masks.child(1)(CurveSite<double>(0, scheme.masks.unknowns()));
  if (scheme.name == "four-point") {
    const double w = -mask.terms().front().second, g = 16 * w;
    bool known = false;
    for (const double tension : {0.0, 0.5, 1.0, 1.5}) known = known || std::abs(g - tension) < 1e-12;
    if (!known) return "the tension is " + std::to_string(g);
    const PointLimits L = limits_at(scheme, Line(scheme, 60).level, {{30, 0}});
    if (g > 0 && std::abs(L.first.coeff(0, 31) - 8 / (4 * (4 - g))) > 1e-12)
      return "the derivative is not the published one";
  }
  if (scheme.name == "hermite-merrien") {
    const Stencil<double> slope = scheme.masks.child(1, 1)(CurveSite<double>(0, 2));
    const auto weight = [](const Stencil<double>& stencil, Index slot) {
      for (const auto& [at, value] : stencil.terms())
        if (at == slot) return value;
      return 0.0;
    };
    const double alpha = weight(mask, 3), beta = 4 * weight(slope, 1);
    if (std::abs(weight(slope, 2) - (1 - beta) / 2) > 1e-12)
      return "the shares of the middle's slope are not of one beta";
    const double known[][2] = {{-1 / 8.0, -1 / 2.0}, {-1 / 8.0, -1}, {-0.2, 0.5}};
    for (const auto& [a, b] : known)
      if (std::abs(alpha - a) + std::abs(beta - b) < 1e-12) return {};
    return "alpha is " + std::to_string(alpha) + ", beta " + std::to_string(beta);
  }
  if (scheme.name == "trigonometric-cubic") {  // both levels are of the same circle: half angles
    double cosine[2];
    for (int k : {0, 1}) {
      const double centre = scheme.masks.point(CurveSite<double>(k)).terms()[1].second;
      cosine[k] = (4 * centre - 2) / (4 - 4 * centre);
    }
    if (std::abs(cosine[0] - (2 * cosine[1] * cosine[1] - 1)) > 1e-12) return "levels are of different angles";
  }
  return {};
}

}  // namespace

const std::vector<CurveLaw>& curve_laws() {
  static const std::vector<CurveLaw> all{
      {"RowsSumToOne", rows_sum_to_one},
      {"CountsFollowTheLayout", counts_follow_the_layout},
      {"CurvesReversedStayThemselves", curves_reversed_stay_themselves},
      {"ClosedCurvesHaveNoFirstPoint", closed_curves_have_no_first_point},
      {"ClaimsAboutWeightsHold", claims_about_weights_hold},
      {"PolynomialsAreGeneratedUpToTheClaim", polynomials_are_generated_up_to_the_claim},
      {"PolynomialsAreReproducedUpToTheClaim", polynomials_are_reproduced_up_to_the_claim},
      {"EndsGoOn", ends_go_on},
      {"LimitsAgreeBetweenLevels", limits_agree_between_levels},
      {"DerivativesFitTheClaim", derivatives_fit_the_claim},
      {"SpectrumFitsTheClaim", spectrum_fits_the_claim},
      {"PublishedValuesHold", published_values_hold},
  };
  return all;
}

std::vector<std::pair<std::string, SchemeOptions>> curve_scheme_names_and_options() {
  std::vector<std::pair<std::string, SchemeOptions>> all;
  for (const CurveScheme<double>& scheme : all_curve_schemes()) all.push_back({scheme.name, {}});
  const std::pair<const char*, SchemeOptions> others[] = {
      {"chaikin", {{"ends", "interpolate"}}},
      {"four-point", {{"tension", "1/2"}, {"ends", "linear"}}},
      {"four-point", {{"tension", "1.5"}, {"ends", "quadratic"}}},
      {"four-point", {{"tension", "0"}}},
      {"lane-riesenfeld", {{"degree", "1"}}},
      {"lane-riesenfeld", {{"degree", "4"}}},
      {"lane-riesenfeld", {{"degree", "5"}, {"ends", "interpolate"}}},
      {"lane-riesenfeld", {{"degree", "6"}, {"ends", "interpolate"}}},
      {"lane-riesenfeld", {{"degree", "9"}}},
      {"six-point", {{"ends", "linear"}}},
      {"six-point", {{"ends", "cubic"}}},
      {"trigonometric-cubic", {{"sides", "3"}, {"ends", "interpolate"}}},
      {"hermite-merrien", {{"beta", "-1"}}},
      {"hermite-merrien", {{"alpha", "-0.2"}, {"beta", "0.5"}}},
  };
  all.insert(all.end(), std::begin(others), std::end(others));
  return all;
}

std::vector<Scheme> curve_scheme_variants() {
  std::vector<Scheme> schemes;
  for (const auto& [name, options] : curve_scheme_names_and_options())
    schemes.push_back(*find_curve_scheme(name, options));
  return schemes;
}

}  // namespace sublimit::testing
