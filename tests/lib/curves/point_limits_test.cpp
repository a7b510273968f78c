// SPDX-License-Identifier: Apache-2.0
// Limits and derivatives of curves against closed forms, and against brute force in 256-bit floats.
#include <gtest/gtest.h>

#include <random>

#include "laws/curve_laws.h"
#include "laws/point_limits.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/curves/detail/curve_levels.h"
#include "sublimit/curves/detail/curve_vertex.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "support/tolerance.h"
#include "truth/precise_schemes.h"

namespace sublimit::testing {
namespace {

std::vector<double> spectrum(const CurveScheme<double>& scheme) {
  const CurveOutline curve = CurveLayout(scheme).control(200, false);
  const Eigen::VectorXcd values = eigenvalues(curve_neighborhood(scheme, curve, 0, 200).A);
  std::vector<double> result;
  for (const std::complex<double> value : values) result.push_back(value.real());
  std::sort(result.rbegin(), result.rend());
  return result;
}

void expect_values(const std::vector<double>& values, std::vector<double> expected, double tolerance) {
  std::sort(expected.rbegin(), expected.rend());
  ASSERT_EQ(values.size(), expected.size());
  for (size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], tolerance) << i;
}

TEST(CurveSpectrum, FourPoint) {
  for (const auto& [text, g] : {std::pair{"1/2", 0.5}, {"3/4", 0.75}, {"0.25", 0.25}}) {
    const double r = std::sqrt(1 - g);
    expect_values(spectrum(*find_curve_scheme("four-point", {{"tension", text}})),
                  {1, 0.5, (1 + r) / 4, (1 - r) / 4, g / 8, -g / 16, -g / 16}, eigen(40));
  }
  // Tension 1: 1/4 is a Jordan block, which a solver splits by the root of rounding.
  expect_values(spectrum(*find_curve_scheme("four-point")), {1, 0.5, 0.25, 0.25, 1 / 8.0, -1 / 16.0, -1 / 16.0},
                std::sqrt(10 * eps));
}

/// Rows of the limit, the first and the second derivative at the middle of a long curve.
PointLimits middle(const CurveScheme<double>& scheme) {
  return limits_at(scheme, control_level(scheme, polygon_through(Points::Zero(200, 2), true)), {{100, 0}});
}

void expect_row(const CurveMatrix<double>& row, const std::vector<double>& expected, double tolerance = eigen()) {
  const Index first = 100 - Index(expected.size() / 2);
  for (Index i = 0; i < row.cols(); ++i) {
    const Index at = i - first;
    EXPECT_NEAR(row.coeff(0, i), at >= 0 && at < Index(expected.size()) ? expected[at] : 0, tolerance)
        << "at " << i - 100;
  }
}

TEST(PointLimits, Chaikin) {
  const PointLimits L = middle(*find_curve_scheme("chaikin"));
  expect_row(L.position, {1 / 8.0, 6 / 8.0, 1 / 8.0});
  expect_row(L.first, {-0.5, 0, 0.5});
  EXPECT_EQ(L.order[0], 2);  // a quadratic around its control point
  expect_row(L.second, {1, -2, 1}, eigen(4));
}

TEST(PointLimits, FourPointDerivative) {
  for (const auto& [text, g] : {std::pair{"1", 1.0}, {"1/2", 0.5}, {"3", 3.0}}) {
    const PointLimits L = middle(*find_curve_scheme("four-point", {{"tension", text}}));
    const double d = 4 * (4 - g);
    expect_row(L.position, {1}, 0);
    expect_row(L.first, {g / d, -8 / d, 0, 8 / d, -g / d});
    EXPECT_EQ(L.order[0], 1);
  }
  EXPECT_EQ(middle(*find_curve_scheme("four-point", {{"tension", "0"}})).order[0], 0);
}

TEST(PointLimits, ChaikinEnds) {
  // Free: the limit starts in the middle of the first edge, along it. Kept: a triple knot, Bezier points v0, v1, (v1 +
  // v2)/2.
  for (const bool kept : {false, true}) {
    const auto scheme = *find_curve_scheme("chaikin", {{"ends", kept ? "interpolate" : "free"}});
    const PointLimits L = point_limits(scheme, control_level(scheme, polygon_through(Points::Zero(9, 2))));
    const auto expect_start = [](const CurveMatrix<double>& rows, std::vector<double> expected) {
      for (Index i = 0; i < 9; ++i) {
        EXPECT_NEAR(rows.coeff(0, i), i < Index(expected.size()) ? expected[i] : 0, eigen());
        EXPECT_NEAR(std::abs(rows.coeff(8, 8 - i)), std::abs(rows.coeff(0, i)), eigen());
      }
    };
    expect_start(L.position, kept ? std::vector<double>{1} : std::vector<double>{0.5, 0.5});
    expect_start(L.first, kept ? std::vector<double>{-2, 2} : std::vector<double>{-1, 1});
    expect_start(L.second, kept ? std::vector<double>{2, -3, 1} : std::vector<double>{1, -2, 1});
  }
}

/// Uniform B-spline basis of a degree at x, centred at 0, by its recurrence (de Boor 1972).
double basis(int degree, double x) {
  if (degree == 0) return x >= -0.5 && x < 0.5 ? 1 : 0;
  const double h = (degree + 1) / 2.0;
  return ((x + h) * basis(degree - 1, x + 0.5) + (h - x) * basis(degree - 1, x - 0.5)) / degree;
}

TEST(PointLimits, LaneRiesenfeldIsTheBSpline) {
  for (int degree = 1; degree <= 9; ++degree) {
    const PointLimits L = middle(*find_curve_scheme("lane-riesenfeld", {{"degree", std::to_string(degree)}}));
    std::vector<double> value, slope;
    for (int i = -degree; i <= degree; ++i) {
      value.push_back(basis(degree, -i));
      slope.push_back(basis(degree - 1, -i + 0.5) - basis(degree - 1, -i - 0.5));
    }
    SCOPED_TRACE(degree);
    expect_row(L.position, value);
    if (degree > 1) expect_row(L.first, slope, eigen(2));
    EXPECT_EQ(L.order[0], degree == 1 ? 0 : 2);
  }
}

TEST(PointLimits, SixPointDerivative) {
  const PointLimits L = middle(*find_curve_scheme("six-point"));
  const double a = 272 / 365.0, b = -53 / 365.0, c = 16 / 1095.0, d = 1 / 2920.0;
  expect_row(L.position, {1}, 0);
  expect_row(L.first, {-d, -c, -b, -a, 0, a, b, c, d});
  EXPECT_EQ(L.order[0], 2);
  const std::vector<double> values = spectrum(*find_curve_scheme("six-point"));
  for (const auto& [i, value] : {std::pair{0, 1.0}, {1, 0.5}, {2, 0.25}, {3, 9 / 64.0}, {4, 0.125}})
    EXPECT_NEAR(values[i], value, eigen(1e3)) << i;
}

TEST(PointLimits, MerrienKeepsPointsAndDerivatives) {
  for (const SchemeOptions& options : {SchemeOptions{}, {{"beta", "-1"}}, {{"alpha", "-1/5"}, {"beta", "1/2"}}}) {
    const CurveScheme<double> scheme = *find_curve_scheme("hermite-merrien", options);
    for (const bool closed : {false, true}) {
      ControlPolygon polygon = polygon_through(Points::Random(7, 2), closed);
      polygon.tangents = Points::Random(7, 2);
      const std::vector<CurveLevel> levels = refine(scheme, polygon, 4);
      const PointLimits L = point_limits(scheme, levels[4]);
      const Points fine = refinement_matrix(levels) * unknowns(scheme, polygon);
      const Points limit = L.position * fine, first = L.first * fine;
      for (Index i = 0; i < 7; ++i) {
        EXPECT_EQ(limit.row(16 * i), polygon.points.row(i));
        EXPECT_LT((first.row(16 * i) - polygon.tangents.row(i)).norm(), eigen(4));
      }
      for (Index i = 0; i < limit.rows(); ++i) {
        EXPECT_GE(L.order[i], 1);
        if (closed || (i > 0 && i + 1 < limit.rows())) {
          EXPECT_EQ(L.order[i], 1);
        }
      }
    }
  }
}

TEST(PointLimits, MerrienIsTheCubicHermiteSpline) {
  const CurveScheme<double> scheme = *find_curve_scheme("hermite-merrien");
  ControlPolygon polygon = polygon_through(Points::Random(2, 3));
  polygon.tangents = Points::Random(2, 3);
  const std::vector<CurveLevel> levels = refine(scheme, polygon, 5);
  const ControlPolygon fine = refined_polygon(levels[5], refinement_matrix(levels) * unknowns(scheme, polygon));
  const auto &p = polygon.points, &d = polygon.tangents;
  for (Index i = 0; i <= 32; ++i) {
    const double t = i / 32.0, s = 1 - t;
    const Eigen::RowVectorXd point = s * s * (1 + 2 * t) * p.row(0) + t * t * (3 - 2 * t) * p.row(1) +
                                     t * s * s * d.row(0) - t * t * s * d.row(1),
                             slope = 6 * t * s * (p.row(1) - p.row(0)) + s * (1 - 3 * t) * d.row(0) +
                                     t * (3 * t - 2) * d.row(1);
    EXPECT_LT((fine.points.row(i) - point).norm(), rounding(4 * 5));
    EXPECT_LT((32 * fine.tangents.row(i) - slope).norm(), rounding(4 * 5, 32));
  }
}

TEST(PointLimits, TrigonometricCubicMakesCircles) {
  for (const int sides : {3, 4, 7, 24, 100000}) {
    SCOPED_TRACE(sides);
    // A third of the polygon may do for many sides; closed, of all sides, for few.
    const Index count = std::min(sides, 60);
    Points points(count, 2);
    for (Index i = 0; i < count; ++i) {
      const double angle = 2 * M_PI * i / sides;
      points.row(i) << std::cos(angle), std::sin(angle);
    }
    const CurveScheme<double> scheme = *find_curve_scheme("trigonometric-cubic", {{"sides", std::to_string(sides)}});
    const std::vector<CurveLevel> levels = refine(scheme, polygon_through(points, sides <= 60), 3);
    const PointLimits L = point_limits(scheme, levels[3]);
    const Points x = refinement_matrix(levels) * points, limit = L.position * x, first = L.first * x,
                 second = L.second * x;
    const double radius = limit.row(0).norm(), turn = 2 * M_PI / sides;
    EXPECT_LT(radius, 1);
    for (Index a = 0; a < x.rows(); ++a) {
      EXPECT_NEAR(limit.row(a).norm(), radius, eigen());
      if (sides == 100000) continue;                              // below rounding
      EXPECT_NEAR(first.row(a).norm(), turn * radius, eigen(8));  // three levels: times 2^3
      EXPECT_NEAR(first.row(a).dot(limit.row(a)), 0, eigen(8));
      ASSERT_EQ(L.order[a], 2);
      EXPECT_NEAR((second.row(a) + turn * turn * limit.row(a)).norm(), 0, eigen(8 * 64));  // times 4^3
    }
  }
}

/// The limit and its derivatives at control points, from refinement alone: 250 levels in 256 bits, differences of the
/// points next to the position.
TEST(PointLimits, EqualBruteForceIn256Bits) {
  const Index size = 11;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  Points points(size, 1);
  for (double& value : points.reshaped()) value = coordinate(random);
  using Values = Eigen::Matrix<Precise, Eigen::Dynamic, 1>;
  for (const auto& [name, options] : curve_scheme_names_and_options()) {
    const CurveScheme<double> scheme = *find_curve_scheme(name, options);
    const CurveScheme<Precise> precise = *find_curve_scheme<Precise>(name, options);
    if (scheme.masks.unknowns() > 1) continue;  // the values and derivatives that it is given stay
    for (const bool closed : {false, true}) {
      SCOPED_TRACE(name + (options.empty() ? "" : " " + options.begin()->first + "=" + options.begin()->second) +
                   (closed ? " closed" : " open"));
      const CurveLevel level = control_level(scheme, polygon_through(points, closed));
      const PointLimits L = point_limits(scheme, level);
      const CurveLayout layout(scheme);
      for (const Index a : {0, 1, 2, 5, 10}) {
        // Follow the position down: a window of points around it, which is all that the next level needs.
        Values values = points.col(0).cast<Precise>();
        CurveOutline outline = layout.control(size, closed);
        std::int64_t position = layout.position(outline, a);
        if (!closed) position = std::clamp<std::int64_t>(position, 0, layout.end(outline));
        for (int k = 0; k < 9; ++k) {
          values = curve_matrix(precise, {outline}, k) * values;
          outline = layout.child(outline);
          position *= 2;
        }
        // Now far from what else there is: cut a window out, and keep cutting.
        const bool at_start = !closed && position == 0, at_end = !closed && position == layout.end(outline);
        const Index reach = 24, window = at_start || at_end ? reach : 2 * reach + 1 + (layout.is_dual() ? 1 : 0);
        const auto nearest = [&](const CurveOutline& c, std::int64_t p) {  // the point there, or the one before
          return layout.is_dual() && !(at_start || at_end) ? layout.point(c, p - 1) : layout.point(c, p);
        };
        const int depth = 250;
        Values cut(window);
        const Index centre = at_start || at_end ? 0 : reach;
        for (Index i = 0; i < window; ++i) {
          const Index from = at_start ? i : at_end ? outline.size - window + i : nearest(outline, position) - reach + i;
          cut[i] = values[(from % outline.size + outline.size) % outline.size];
        }
        const CurveOutline piece = layout.control(window, false);
        const Index at = at_end ? window - 1 : centre;
        // Rows sum to one: what the window has in common can be taken out, and the rest doubled, so that no digits are
        // lost over many levels.
        Precise limit = 0, scale = 1;
        for (int k = 9; k < depth; ++k) {
          const Precise common = cut[at];
          for (Precise& value : cut) value = 2 * (value - common);
          limit += scale * common;
          scale /= 2;
          const Values fine = curve_matrix(precise, {piece}, k) * cut;
          const CurveOutline child = layout.child(piece);
          for (Index i = 0; i < window; ++i) {
            if (at_start)
              cut[i] = fine[i];
            else if (at_end)
              cut[i] = fine[child.size - window + i];
            else {
              // Inside, the window's middle point or edge is at the same place of the child.
              const std::int64_t p = layout.position(piece, centre) + (layout.is_dual() ? 1 : 0);
              cut[i] =
                  fine[(layout.is_dual() ? layout.point(child, 2 * p - 1) : layout.point(child, 2 * p)) - reach + i];
            }
          }
        }
        const bool between = layout.is_dual() && !(at_start || at_end);
        limit += scale * (between ? Precise((cut[at] + cut[at + 1]) / 2) : cut[at]);
        const double value = (L.position * points)(a, 0);
        EXPECT_NEAR(double(limit - Precise(value)), 0, eigen()) << "limit at point " << a;
        // Derivative: the difference of neighbours, 2^depth times their distance in edges.
        if (L.order[a] > 0) {
          const Index i = at_start ? (layout.keeps_ends() && layout.is_dual() ? 1 : 0)
                          : at_end ? window - 2 - (layout.keeps_ends() && layout.is_dual() ? 1 : 0)
                                   : at;
          const Precise slope = (cut[i + 1] - cut[i]) * pow(Precise(2), 9);
          EXPECT_NEAR(double(slope - Precise((L.first * points)(a, 0))), 0, eigen(40)) << "derivative at point " << a;
        }
      }
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
