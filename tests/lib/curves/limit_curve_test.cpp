// SPDX-License-Identifier: Apache-2.0
// Limits of curves at any place against closed forms, against refinement in 256 bits, and by laws.
#include "sublimit/curves/limit_curve.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "laws/curve_laws.h"
#include "laws/full_sweep.h"
#include "laws/stationary.h"
#include "lib/curves/curve_truth.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Positions, relative to the largest coordinate; a descent is some fifty steps of averages.
constexpr double position_tolerance = 2e-14;
/// Of the polynomials of splines: fewer roundings.
constexpr double spline_tolerance = 1e-14;
/// Derivatives of splines take differences of their coefficients, which cost a digit, and of degree 15 are large sums.
double spline_derivative_tolerance(double derivative) { return 10 * spline_tolerance + 1e-12 * std::abs(derivative); }
/// Of points of size 1: a smaller derivative is a sum that cancels, and is as exact as one of this size.
constexpr double cancelled = 1e-3;
/// Points of six steps of arcs against the arcs themselves; tangents are directions of legs, then 1/64 as long.
constexpr double refined_arcs = 1e-12, refined_tangents = 100 * refined_arcs;
/// Central differences of the tangents of arcs: beside the step's square times the third power of the curvature, eps by
/// the step.
constexpr double difference_step = 1e-5, difference_error = 1e-8;

using Variants = std::vector<std::pair<std::string, SchemeOptions>>;

/// Every scheme with default and other options, all degrees, all ends.
Variants all_variants() {
  Variants all = curve_scheme_names_and_options();
  for (int degree = 1; degree <= 15; ++degree)
    for (const char* ends : {"free", "interpolate"})
      all.push_back({"lane-riesenfeld", {{"degree", std::to_string(degree)}, {"ends", ends}}});
  all.push_back({"trigonometric-cubic", {{"sides", "5"}}});
  return all;
}

std::string described(const std::string& name, const SchemeOptions& options, bool closed) {
  std::string text = name;
  for (const auto& [key, value] : options) text += " " + key + "=" + value;
  return text + (closed ? ", closed" : ", open");
}

Points random_points(Index size, int dimension, unsigned seed = 5) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  Points points(size, dimension);
  for (double& value : points.reshaped()) value = coordinate(random);
  return points;
}

ControlPolygon random_polygon(Index size, bool closed, int dimension = 2) {
  ControlPolygon polygon = polygon_through(random_points(size, dimension), closed);
  polygon.tangents = random_points(size, dimension, 6);
  return polygon;
}

/// Places of all kinds: random and dyadic ones, and close to points and middles of legs, from 2^-1 to 2^-40 away.
std::vector<double> parameters() {
  std::vector<double> all{0, 1, 0.5, 0.25, 0.625, 1 / 3.0, 0.7, 1e-300};
  for (int k = 1; k <= 40; k += 3) {
    const double h = std::ldexp(1.0, -k);
    for (const double t : {h, 1 - h, 0.5 + h / 2, 0.5 - h / 2}) all.push_back(t);
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> between(0, 1);
  for (int i = 0; i < 6; ++i) all.push_back(between(random));
  return all;
}

double value(const CurveStencil& stencil, const Points& x, int derivative, Index column = 0) {
  double sum = 0;
  for (size_t i = 0; i < stencil.unknowns.size(); ++i)
    sum += stencil.weights(derivative, Eigen::Index(i)) * x(stencil.unknowns[i], column);
  return sum;
}
int order_of(const CurveStencil& stencil) { return static_cast<int>(stencil.weights.rows()) - 1; }

/// Position of a sample in half legs: of its point, and from there.
struct HalfSegments {
  std::int64_t point;
  double rest;
  double sum() const { return static_cast<double>(point) + rest; }
};
HalfSegments half_segments(const CurveLayout& layout, const CurveOutline& curve, const CurvePlace& place) {
  const std::int64_t from = layout.position(curve, place.segment);
  const double length = curve.closed ? 2 : static_cast<double>(layout.position(curve, place.segment + 1) - from);
  return {from, length * place.t};
}

/// Cardinal B-splines of a degree at `fraction` + 0, 1, ..., degree, where B is positive on (0, degree + 1).
std::vector<long double> cardinal(int degree, long double fraction) {
  std::vector<long double> b{1};
  for (int d = 1; d <= degree; ++d) {
    std::vector<long double> next(d + 1);
    for (int j = 0; j <= d; ++j)
      next[j] = ((j < d ? (fraction + j) * b[j] : 0) + (j > 0 ? (d + 1 - fraction - j) * b[j - 1] : 0)) / d;
    b = next;
  }
  return b;
}

/// Cox and de Boor's recurrence: the uniform B-spline of a degree whose basis functions are centred at every second
/// half leg, the point at X being x(X).
template <class PointAt>
long double spline(int degree, const HalfSegments& at, bool before, int derivative, const PointAt& x) {
  // Differences of the points, with the degree lowered: centres lie between.
  const auto difference = [&](auto&& self, int k, std::int64_t X) -> long double {
    return k == 0 ? x(X) : self(self, k - 1, X + 1) - self(self, k - 1, X - 1);
  };
  const int d = degree - derivative;
  // The support of the basis function at X is X -+ (d + 1); centres are at the parity of d + 1, knots at even
  // positions.
  const auto whole = static_cast<std::int64_t>(std::floor(at.rest / 2 + (at.point % 2 == 0 ? 0 : 0.5)));
  const std::int64_t knot = at.point - (at.point % 2 == 0 ? 0 : 1) + 2 * (whole - (before ? 1 : 0));
  const long double fraction = (static_cast<long double>(at.point - knot) + at.rest) / 2;
  const std::vector<long double> b = cardinal(d, fraction);
  long double sum = 0;
  for (int j = 0; j <= d; ++j) sum += b[j] * difference(difference, derivative, knot - 2 * j + d + 1);
  return sum;
}

TEST(LimitCurve, LaneRiesenfeldIsTheBSplineOfCoxAndDeBoor) {
  const Index size = 12;
  const Points points = random_points(size, 1);
  for (int degree = 1; degree <= 15; ++degree)
    for (const char* ends : {"free", "interpolate", "closed"}) {
      const bool closed = ends == std::string("closed"), kept = ends == std::string("interpolate");
      const Index count = !closed && !kept && degree > 10 ? 20 : size;
      const Points data = count == size ? points : random_points(count, 1);
      SCOPED_TRACE(described("degree " + std::to_string(degree), {{"ends", ends}}, closed));
      const CurveScheme<double> scheme = *find_curve_scheme(
          "lane-riesenfeld", {{"degree", std::to_string(degree)}, {"ends", kept ? "interpolate" : "free"}});
      const CurveLayout layout(scheme);
      const CurveOutline curve = layout.control(count, closed);
      const LimitCurve limit(scheme, polygon_through(data, closed));
      // Beyond kept ends the points go on as their reflection.
      const auto point = [&](auto&& self, std::int64_t X) -> long double {
        if (closed || !kept) return data(layout.point(curve, X), 0);
        const std::int64_t end = layout.end(curve);
        if (X < 0) return 2 * static_cast<long double>(data(0, 0)) - self(self, -X);
        if (X > end) return 2 * static_cast<long double>(data(count - 1, 0)) - self(self, 2 * end - X);
        return data(layout.point(curve, X), 0);
      };
      const auto x = [&](std::int64_t X) { return point(point, X); };
      for (Index segment = 0; segment < limit.num_segments(); ++segment)
        for (const double t : parameters()) {
          const CurveStencil stencil = limit.stencil({segment, t}, 2);
          if (stencil.status == LimitStatus::outside) continue;
          const HalfSegments at = half_segments(layout, curve, {segment, t});
          const auto end = static_cast<double>(layout.end(curve));
          const bool at_end = !closed && at.sum() == end;  // the piece before
          const double expected = double(spline(degree, at, at_end, 0, x));
          EXPECT_NEAR(value(stencil, data, 0), expected, spline_tolerance) << segment << " " << t;
          const double knot_distance = std::remainder(at.sum(), 2.0);
          const bool knot = at.rest == std::floor(at.rest) && knot_distance == 0;
          EXPECT_EQ(order_of(stencil), knot && degree == 2 && stencil.status != LimitStatus::crease ? 1 : 2)
              << segment << " " << t;
          for (int k = 1; k <= std::min(order_of(stencil), degree); ++k) {
            if (knot && degree <= k) continue;  // one-sided: the sides of segments are tested below
            const double slope = double(spline(degree, at, at_end, k, x));
            EXPECT_NEAR(value(stencil, data, k), slope, spline_derivative_tolerance(slope))
                << segment << " " << t << " derivative " << k;
          }
        }
    }
}

/// The dual four-point scheme of Dyn, Floater and Hormann, C^2: no scheme of the registry is dual without being a
/// spline.
template <class T>
CurveScheme<T> dual_four_point(bool kept) {
  return {.name = "dual-four-point",
          .source = "Dyn, Floater, Hormann 2005, A C2 four-point subdivision scheme with fourth order accuracy",
          .masks = {.before =
                        [](const CurveSite<T>& p) {
                          return (-7 * p.point(1) + 105 * p.point(0) + 35 * p.point(-1) - 5 * p.point(-2)) / 128;
                        },
                    .after =
                        [](const CurveSite<T>& p) {
                          return (-7 * p.point(-1) + 105 * p.point(0) + 35 * p.point(1) - 5 * p.point(2)) / 128;
                        }},
          .ends = kept ? reflected_ends<T>() : CurveEnds<T>{},
          .claims = {.regular = 2, .generates = 4, .reproduces = 3, .limit = {}, .exponent = {}}};
}

/// Compares with brute force at many places of a curve.
void expect_truth(const CurveScheme<double>& scheme, const CurveScheme<Precise>& precise, bool closed, Index size) {
  const Points points = random_points(size, 1);
  const LimitCurve limit(scheme, polygon_through(points, closed));
  const bool stationary = is_stationary(scheme);
  CurveBruteForce truth(precise, points.col(0), closed, stationary);
  const CurveLayout layout(scheme);
  const CurveOutline curve = layout.control(size, closed);
  const Index last = limit.num_segments() - 1;
  const std::vector<double> all = parameters();
  static size_t turn = 0;  // each curve gets other places: some of all, and these
  const size_t stride = full_sweep() ? 7 : 13;
  std::vector<double> some{0, 1, 0x1p-40};
  for (turn = (turn + 1) % stride; some.size() < 3 + all.size() / stride;)
    some.push_back(all[turn + stride * (some.size() - 3)]);
  for (const Index segment : std::set<Index>{0, std::min<Index>(1, last), last / 2, last})
    for (const double t : some) {
      if (t > 0 && t < 1e-100) continue;  // deeper than the truth goes
      const CurveStencil stencil = limit.stencil({segment, t}, 2);
      const HalfSegments at = half_segments(layout, curve, {segment, t});
      if (!closed && (at.sum() < 0 || at.sum() > static_cast<double>(layout.end(curve)))) {
        EXPECT_EQ(stencil.status, LimitStatus::outside);
        continue;
      }
      const CurveTruth expected = truth.at(static_cast<double>(at.point), at.rest);
      EXPECT_NEAR(value(stencil, points, 0), double(expected.position), position_tolerance) << segment << " " << t;
      // Where sides differ, at corners, brute force has the side behind.
      if (stencil.status == LimitStatus::crease && t == 1 && segment < last + (closed ? 1 : 0)) continue;
      if (order_of(stencil) >= 1) {
        EXPECT_NEAR(value(stencil, points, 1), double(expected.first),
                    first_derivative * std::abs(double(expected.first)))
            << segment << " " << t;
      }
      if (order_of(stencil) >= 2) {
        const double second = double(expected.second);
        EXPECT_NEAR(value(stencil, points, 2), second, second_derivative * std::max(cancelled, std::abs(second)))
            << segment << " " << t;
      }
    }
}

TEST(LimitCurve, EqualsBruteForceIn256Bits) {
  Variants some = curve_scheme_names_and_options();
  for (const char* degree : {"2", "12", "14", "15"})
    some.push_back({"lane-riesenfeld", {{"degree", degree}, {"ends", "interpolate"}}});
  for (const auto& [name, options] : some) {
    const CurveScheme<double> scheme = *find_curve_scheme(name, options);
    if (scheme.masks.unknowns() > 1) continue;  // below
    for (const bool closed : {false, true}) {
      SCOPED_TRACE(described(name, options, closed));
      expect_truth(scheme, *find_curve_scheme<Precise>(name, options), closed,
                   closed ? 7 : std::max<Index>(9, CurveLayout(scheme).least_points(false) + 2));
    }
  }
}

TEST(LimitCurve, OfASchemeOfOnesOwnEqualsBruteForce) {
  for (const bool kept : {false, true})
    for (const bool closed : {false, true}) {
      SCOPED_TRACE(described("dual four-point", {{"ends", kept ? "kept" : "free"}}, closed));
      expect_truth(dual_four_point<double>(kept), dual_four_point<Precise>(kept), closed, 9);
      const LimitCurve limit(dual_four_point<double>(kept), random_polygon(9, closed));
      EXPECT_EQ(limit.stencil({4, 0.3}, 2).status, LimitStatus::regular);
    }
}

TEST(LimitCurve, OfShortCurvesEqualsBruteForce) {
  for (const auto& [name, options] : curve_scheme_names_and_options()) {
    const CurveScheme<double> scheme = *find_curve_scheme(name, options);
    if (scheme.masks.unknowns() > 1) continue;
    for (const bool closed : {false, true}) {
      SCOPED_TRACE(described(name, options, closed));
      expect_truth(scheme, *find_curve_scheme<Precise>(name, options), closed,
                   CurveLayout(scheme).least_points(closed));
    }
  }
}

TEST(LimitCurve, RowsSumToOneAndZero) {
  for (const auto& [name, options] : all_variants())
    for (const bool closed : {false, true}) {
      const CurveScheme<double> scheme = *find_curve_scheme(name, options);
      SCOPED_TRACE(described(name, options, closed));
      const Index size = std::max<Index>(11, CurveLayout(scheme).least_points(closed));
      const LimitCurve limit(scheme, random_polygon(size, closed));
      const int unknowns = scheme.masks.unknowns();
      for (Index segment = 0; segment < limit.num_segments(); ++segment)
        for (const double t : parameters()) {
          const CurveStencil stencil = limit.stencil({segment, t}, 2);
          EXPECT_TRUE(std::is_sorted(stencil.unknowns.begin(), stencil.unknowns.end()));
          for (int k = 0; k <= order_of(stencil); ++k) {
            double sum = 0, size_of_row = 0;
            for (size_t i = 0; i < stencil.unknowns.size(); ++i)
              if (stencil.unknowns[i] % unknowns == 0) {
                sum += stencil.weights(k, Eigen::Index(i));
                size_of_row += std::abs(stencil.weights(k, Eigen::Index(i)));
              }
            EXPECT_NEAR(sum, k == 0 ? 1 : 0, k == 0 ? rounding(64) : rounding(16, size_of_row)) << segment << " " << t;
          }
          if (scheme.claims.convex_hull && unknowns == 1) {
            EXPECT_GE(stencil.weights.row(0).minCoeff(), -rounding(1));
          }
        }
    }
}

TEST(LimitCurve, IsTheSameFromTheNextLevel) {
  for (const auto& [name, options] : all_variants())
    for (const bool closed : {false, true}) {
      const CurveScheme<double> scheme = *find_curve_scheme(name, options);
      SCOPED_TRACE(described(name, options, closed));
      const CurveLayout layout(scheme);
      const Index size = std::max<Index>(9, layout.least_points(closed) + 1);
      const ControlPolygon polygon = random_polygon(size, closed, 1);
      const std::vector<CurveLevel> levels = refine(scheme, polygon, 1);
      const Points coarse = unknowns(scheme, polygon), fine = levels[1].S * coarse;
      const LimitCurve from_coarse(scheme, polygon), from_fine(scheme, levels[1]);
      const CurveOutline &parent = levels[0].curves[0], &child = levels[1].curves[0];
      for (Index segment = 0; segment < from_coarse.num_segments(); ++segment)
        for (const double t : parameters()) {
          const HalfSegments at = half_segments(layout, parent, {segment, t});
          // The child segment that this place lies on.
          const double place = 2 * at.sum(), all = 2.0 * child.size;
          Index on = -1;
          double s = 0;
          for (Index i = 0; i < from_fine.num_segments() && on < 0; ++i) {
            const std::int64_t point = layout.position(child, i);
            const double length = closed ? 2 : static_cast<double>(layout.position(child, i + 1) - point);
            s = (static_cast<double>(2 * at.point - point) + 2 * at.rest) / length;
            if (closed && s < 0) s += all / 2;
            if (s >= 0 && s <= 1 && !(s == 1 && t < 1)) on = i;
            if (s == 1 && t == 1) on = i;
          }
          if (on < 0) {
            EXPECT_EQ(from_coarse.stencil({segment, t}).status, LimitStatus::outside) << place;
            continue;
          }
          const CurveStencil a = from_coarse.stencil({segment, t}, 2), b = from_fine.stencil({on, s}, 2);
          EXPECT_NEAR(value(a, coarse, 0), value(b, fine, 0), position_tolerance) << segment << " " << t;
          for (int k = 1; k <= std::min(order_of(a), order_of(b)); ++k) {
            const double expected = value(b, fine, k) * (1 << k);
            EXPECT_NEAR(value(a, coarse, k), expected,
                        (k == 1 ? first_derivative : second_derivative) * std::max(cancelled, std::abs(expected)))
                << segment << " " << t << " derivative " << k;
          }
        }
    }
}

TEST(LimitCurve, SidesOfAPointAgree) {
  for (const auto& [name, options] : all_variants())
    for (const bool closed : {false, true}) {
      const CurveScheme<double> scheme = *find_curve_scheme(name, options);
      SCOPED_TRACE(described(name, options, closed));
      const Index size = std::max<Index>(9, CurveLayout(scheme).least_points(closed));
      const ControlPolygon polygon = random_polygon(size, closed);
      const LimitCurve limit(scheme, polygon);
      const Points x = unknowns(scheme, polygon);
      const Index count = limit.num_segments();
      for (Index segment = 0; segment + (closed ? 0 : 1) < count; ++segment) {
        const CurveStencil before = limit.stencil({segment, 1}, 2),
                           behind = limit.stencil({(segment + 1) % count, 0}, 2);
        EXPECT_EQ(before.status, behind.status);
        if (before.status != LimitStatus::crease) {
          EXPECT_EQ(before.unknowns, behind.unknowns);
          EXPECT_EQ(before.weights, behind.weights);
        } else {
          EXPECT_NEAR(value(before, x, 0), value(behind, x, 0), rounding(2));
          if (scheme.claims.regular == 0 && segment > 0 && segment + 2 < count) {  // polygons: each side has its leg's
            const Index end = (segment + 1) % size, next = (segment + 2) % size;
            EXPECT_NEAR(value(before, x, 1), x(end, 0) - x(segment, 0), rounding(8));
            EXPECT_NEAR(value(behind, x, 1), x(next, 0) - x(end, 0), rounding(8));
          }
        }
      }
    }
}

TEST(LimitCurve, ReproducesPolynomialsUpToTheClaim) {
  for (const auto& [name, options] : all_variants()) {
    const CurveScheme<double> scheme = *find_curve_scheme(name, options);
    SCOPED_TRACE(described(name, options, false));
    const Index size = 50, middle = 24;
    for (int degree = 0; degree <= scheme.claims.reproduces; ++degree) {
      const int unknowns = scheme.masks.unknowns();
      Points x(size * unknowns, 1);
      for (Index i = 0; i < size; ++i) {
        x(i * unknowns, 0) = std::pow(i - middle, degree);
        if (unknowns == 2) x(2 * i + 1, 0) = degree == 0 ? 0 : degree * std::pow(i - middle, degree - 1);
      }
      // Points of dual schemes with kept ends lie at halves of legs; their segments tell.
      const LimitCurve limit(scheme, [&] {
        ControlPolygon polygon = polygon_through(Points::Zero(size, 1));
        polygon.tangents = Points::Zero(size, 1);
        return polygon;
      }());
      for (const double t : parameters()) {
        const CurveStencil stencil = limit.stencil({middle, t}, 2);
        double expected = std::pow(t, degree);
        const double scale = std::pow(10, degree);
        for (int k = 0; k <= order_of(stencil); ++k) {
          const double factor = k == 0 ? 1 : k == 1 ? degree : degree * (degree - 1);
          expected = k > degree ? 0 : factor * std::pow(t, degree - k);
          EXPECT_NEAR(value(stencil, x, k), expected, rounding(64, scale) * (k + 1)) << t << " degree " << degree;
        }
      }
    }
  }
}

TEST(LimitCurve, TrigonometricCubicMakesCirclesEverywhere) {
  for (const int sides : {3, 4, 7, 24}) {
    SCOPED_TRACE(sides);
    const double turn = 2 * std::numbers::pi / sides;
    Points points(sides, 2);
    for (Index i = 0; i < sides; ++i) points.row(i) << std::cos(turn * i), std::sin(turn * i);
    const LimitCurve limit(*find_curve_scheme("trigonometric-cubic", {{"sides", std::to_string(sides)}}),
                           polygon_through(points, true));
    std::vector<CurvePlace> samples;
    for (Index i = 0; i < sides; ++i)
      for (const double t : parameters()) samples.push_back({i, t});
    const CurveSamples result = limit.evaluate(points, samples, 2);
    const double radius = result.position.row(0).norm();
    EXPECT_LT(radius, 1);
    for (Index i = 0; i < result.position.rows(); ++i) {
      const Eigen::RowVector2d p = result.position.row(i), first = result.first.row(i), second = result.second.row(i);
      EXPECT_NEAR(p.norm(), radius, spline_tolerance) << samples[i].t;
      EXPECT_NEAR(first.norm(), turn * radius, first_derivative);
      EXPECT_NEAR((second + turn * turn * p).norm(), 0, second_derivative);
      EXPECT_NEAR((result.normal.row(i) + p / radius).norm(), 0, first_derivative);  // inwards, left of the curve
      const double angle = turn * (samples[i].segment + samples[i].t);
      EXPECT_NEAR((p - radius * Eigen::RowVector2d(std::cos(angle), std::sin(angle))).norm(), 0, spline_tolerance);
      EXPECT_EQ(result.status[i], LimitStatus::regular);
    }
  }
}

TEST(LimitCurve, MerrienIsTheCubicHermiteSpline) {
  const CurveScheme<double> scheme = *find_curve_scheme("hermite-merrien");
  for (const bool closed : {false, true}) {
    const ControlPolygon polygon = random_polygon(5, closed, 3);
    const LimitCurve limit(scheme, polygon);
    const Points x = unknowns(scheme, polygon);
    for (Index segment = 0; segment < limit.num_segments(); ++segment)
      for (const double t : parameters()) {
        const CurveStencil stencil = limit.stencil({segment, t}, 2);
        const double s = 1 - t;
        const double h[3][4] = {{s * s * (1 + 2 * t), t * s * s, t * t * (3 - 2 * t), -t * t * s},
                                {-6 * t * s, s * (1 - 3 * t), 6 * t * s, t * (3 * t - 2)},
                                {12 * t - 6, 6 * t - 4, 6 - 12 * t, 6 * t - 2}};
        const bool end = !closed && ((segment == 0 && t == 0) || (segment == limit.num_segments() - 1 && t == 1));
        const bool knot = t == 0 || t == 1;
        EXPECT_EQ(stencil.status, end    ? LimitStatus::crease
                                  : knot ? LimitStatus::unbounded_second
                                         : LimitStatus::regular);
        for (int k = 0; k <= order_of(stencil); ++k) {
          double expected = 0;
          for (int j = 0; j < 4; ++j) expected += h[k][j] * x((2 * segment + j) % x.rows(), 0);
          EXPECT_NEAR(value(stencil, x, k), expected, rounding(4, 24)) << segment << " " << t << " derivative " << k;
        }
      }
  }
}

/// Of Hermite schemes that are no cubics, refined points and derivatives are on the limit.
TEST(LimitCurve, OfHermiteSchemesPassesThroughRefinedPoints) {
  for (const SchemeOptions& options : {SchemeOptions{{"beta", "-1"}}, {{"alpha", "-0.2"}, {"beta", "0.5"}}}) {
    const CurveScheme<double> scheme = *find_curve_scheme("hermite-merrien", options);
    for (const bool closed : {false, true}) {
      const ControlPolygon polygon = random_polygon(4, closed, 1);
      const LimitCurve limit(scheme, polygon);
      const Points x = unknowns(scheme, polygon);
      const std::vector<CurveLevel> levels = refine(scheme, polygon, 9);
      const Points fine = refinement_matrix(levels) * x;
      for (Index i = 0; i < limit.num_segments() * 512; ++i) {
        const CurveStencil stencil = limit.stencil({i / 512, (i % 512) / 512.0}, 1);
        EXPECT_NEAR(value(stencil, x, 0), fine(2 * i, 0), rounding(36));
        ASSERT_GE(order_of(stencil), 1);
        EXPECT_NEAR(value(stencil, x, 1), 512 * fine(2 * i + 1, 0), rounding(36, 512));
      }
    }
  }
}

TEST(LimitCurve, TellsWhatThereIs) {
  const auto status = [](const std::string& name, const SchemeOptions& options, CurvePlace place, bool closed = false) {
    const CurveStencil stencil =
        LimitCurve(*find_curve_scheme(name, options), random_polygon(9, closed)).stencil(place, 2);
    return std::pair(stencil.status, order_of(stencil));
  };
  using enum LimitStatus;
  EXPECT_EQ(status("chaikin", {}, {4, 0}), std::pair(regular, 2));
  EXPECT_EQ(status("chaikin", {}, {4, 0.5}), std::pair(unbounded_second, 1));  // a knot
  EXPECT_EQ(status("chaikin", {}, {0, 0.25}), std::pair(outside, 0));
  EXPECT_EQ(status("chaikin", {}, {0, 0.5}), std::pair(crease, 2));  // where the limit starts
  EXPECT_EQ(status("chaikin", {}, {7, 0.5}), std::pair(crease, 2));
  EXPECT_EQ(status("chaikin", {}, {7, 0.75}), std::pair(outside, 0));
  EXPECT_EQ(status("chaikin", {{"ends", "interpolate"}}, {0, 0}), std::pair(crease, 2));
  EXPECT_EQ(status("chaikin", {{"ends", "interpolate"}}, {7, 1}), std::pair(crease, 2));
  EXPECT_EQ(status("lane-riesenfeld", {{"degree", "1"}}, {3, 1}), std::pair(crease, 2));
  EXPECT_EQ(status("lane-riesenfeld", {{"degree", "1"}}, {3, 0.5}), std::pair(regular, 2));
  EXPECT_EQ(status("four-point", {}, {4, 0.3}), std::pair(unbounded_second, 1));
  EXPECT_EQ(status("four-point", {}, {0, 0.3}), std::pair(regular, 2));  // the cubic of the end
  EXPECT_EQ(status("four-point", {}, {0, 0}), std::pair(crease, 2));
  EXPECT_EQ(status("four-point", {{"tension", "1/2"}}, {0, 0}), std::pair(crease, 1));
  EXPECT_EQ(status("six-point", {}, {4, 0.3}, true), std::pair(regular, 2));
  EXPECT_EQ(status("trigonometric-cubic", {}, {0, 1}), std::pair(crease, 2));
  EXPECT_EQ(status("trigonometric-cubic", {}, {0, 0.5}), std::pair(outside, 0));
  EXPECT_EQ(status("trigonometric-cubic", {}, {4, 0.3}), std::pair(regular, 2));
  EXPECT_EQ(status("hermite-merrien", {{"beta", "-1"}}, {4, 0.5}), std::pair(unbounded_second, 1));
  EXPECT_EQ(status("hermite-merrien", {{"beta", "-1"}}, {4, 0.3}), std::pair(regular, 2));
  EXPECT_EQ(status("hermite-merrien", {{"alpha", "-0.2"}, {"beta", "0.5"}}, {4, 0.3}), std::pair(unbounded_second, 1));
  // One-sided limits beyond free ends.
  const LimitCurve limit(*find_curve_scheme("lane-riesenfeld"), random_polygon(9, false));
  EXPECT_EQ(limit.stencil({0, 0.2}).weights, limit.stencil({1, 0}).weights);
  EXPECT_EQ(limit.stencil({7, 0.2}).weights, limit.stencil({6, 1}).weights);
}

TEST(LimitCurve, NumbersSegmentsThroughAllCurves) {
  ControlPolygon polygon = polygon_through(random_points(20, 3));
  polygon.curves = {{{3, 1, 2, 0, 4, 19, 18}, true},
                    {{5, 6, 7, 8, 9, 10, 5, 12, 3, 13}, false}};  // meets point 5 twice
  const CurveScheme<double> scheme = *find_curve_scheme("four-point");
  const LimitCurve limit(scheme, polygon);
  EXPECT_EQ(limit.num_curves(), 2);
  EXPECT_EQ(limit.num_segments(), 7 + 9);
  EXPECT_EQ(limit.first_segment(1), 7);
  EXPECT_EQ(limit.num_unknowns(), 20);
  EXPECT_EQ(limit.stencil({0, 0}).unknowns.size(), 6u);
  const auto at = [&](Index segment, double t) {
    const std::vector<CurvePlace> samples{{segment, t}};
    return Points(limit.evaluate(polygon.points, samples).position);
  };
  EXPECT_EQ(at(0, 0), polygon.points.row(3));
  EXPECT_EQ(at(6, 1), polygon.points.row(3));  // round the closed curve
  EXPECT_EQ(at(7, 0), polygon.points.row(5));
  EXPECT_EQ(at(12, 1), polygon.points.row(5));
  EXPECT_EQ(at(13, 1), polygon.points.row(12));
  EXPECT_EQ(at(15, 1), polygon.points.row(13));
  EXPECT_DOUBLE_EQ(limit.parameter({9, 0.25}), 2.25);
  const LimitCurve dual(*find_curve_scheme("chaikin", {{"ends", "interpolate"}}), random_polygon(5, false));
  EXPECT_DOUBLE_EQ(dual.parameter({0, 1}), 0.5);
  EXPECT_DOUBLE_EQ(dual.parameter({1, 0.5}), 1);
  EXPECT_DOUBLE_EQ(dual.parameter({3, 1}), 3);
  EXPECT_EQ(limit.grid(3).size(), 48u);
  EXPECT_EQ(limit.grid(3)[4].t, 0.5);
}

TEST(LimitCurve, EvaluatesWhatItsStencilsSay) {
  for (const auto& [name, options] : curve_scheme_names_and_options())
    for (const bool closed : {false, true}) {
      const CurveScheme<double> scheme = *find_curve_scheme(name, options);
      SCOPED_TRACE(described(name, options, closed));
      const ControlPolygon polygon = random_polygon(11, closed, 3);
      const LimitCurve limit(scheme, polygon);
      const Points x = unknowns(scheme, polygon);
      std::vector<CurvePlace> samples;
      for (int repeat = 0; repeat < 3; ++repeat)
        for (Index segment = 0; segment < limit.num_segments(); ++segment)
          for (const double t : parameters()) samples.push_back({segment, t});
      const CurveSamples result = limit.evaluate(x, samples, 2);
      for (size_t i = 0; i < samples.size() / 3; ++i) {
        const CurveStencil stencil = limit.stencil(samples[i], 2);
        EXPECT_EQ(result.order[i], order_of(stencil));
        EXPECT_EQ(result.status[i], stencil.status);
        const Points* parts[] = {&result.position, &result.first, &result.second};
        for (int k = 0; k <= 2; ++k)
          for (Index c = 0; c < 3; ++c) {
            const double expected = k <= order_of(stencil) ? value(stencil, x, k, c) : 0;
            const double size = k <= order_of(stencil) ? stencil.weights.row(k).cwiseAbs().sum() : 0;
            EXPECT_NEAR((*parts[k])(i, c), expected, rounding(4, size));
          }
        // The same place again has the same bits.
        const size_t again = i + samples.size() / 3;
        EXPECT_EQ(result.position.row(i), result.position.row(again));
        EXPECT_EQ(result.second.row(i), result.second.row(again));
        if (result.order[i] < 2) continue;
        const Eigen::Vector3d normal = result.normal.row(i), first = result.first.row(i), second = result.second.row(i);
        if (normal.norm() == 0) continue;  // straight
        EXPECT_NEAR(normal.norm(), 1, rounding(4));
        EXPECT_NEAR(normal.dot(first) / first.norm(), 0, reference_angle);
        EXPECT_GT(normal.dot(second), 0);
      }
    }
}

TEST(LimitCurve, OfEqualPointsHasNoNormal) {
  const Points points = Points::Ones(8, 2);
  const std::vector<CurvePlace> samples{{3, 0.3}, {0, 0.7}};
  const CurveSamples result =
      LimitCurve(*find_curve_scheme("six-point"), polygon_through(points)).evaluate(points, samples, 1);
  for (const LimitStatus status : result.status) EXPECT_EQ(status, LimitStatus::undefined_normal);
  EXPECT_TRUE(result.normal.isZero(0));
  EXPECT_LT((result.position - Points::Ones(2, 2)).norm(), rounding(64));
}

TEST(LimitCurve, RefusesPlacesThatDoNotExist) {
  const Points points = random_points(8, 2);
  const LimitCurve limit(*find_curve_scheme("six-point"), polygon_through(points));
  const double nan = std::nan("");
  expect_error<InvalidParameter>([&] { limit.stencil({7, 0.5}); }, {"segment 7", "0 to 6"});
  expect_error<InvalidParameter>([&] { limit.stencil({-1, 0.5}); }, {"segment -1"});
  expect_error<InvalidParameter>([&] { limit.stencil({3, 1.5}); }, {"t is 1.5", "from 0 to 1"});
  expect_error<InvalidParameter>([&] { limit.stencil({3, -1e-300}); }, {"t is -1e-300"});
  expect_error<InvalidParameter>([&] { limit.stencil({3, nan}); }, {"t is nan"});
  expect_error<InvalidParameter>([&] { limit.stencil({3, 0.5}, 3); }, {"order 3"});
  expect_error<InvalidParameter>([&] { limit.grid(1); }, {"2 or more"});
  expect_error<InvalidParameter>([&] { limit.first_segment(1); }, {"curve 1"});
  const std::vector<CurvePlace> samples{{0, 0}, {3, 0.5}, {3, nan}};
  expect_error<InvalidParameter>([&] { limit.evaluate(points, samples); }, {"sample 2", "t is nan"});
  expect_error<InvalidParameter>([&] { limit.evaluate(Points::Zero(7, 2), samples); }, {"7 x 2", "8 control points"});
  expect_error<UnsupportedTopology>([&] { LimitCurve(*find_curve_scheme("six-point"), random_polygon(2, false)); },
                                    {"needs at least 6"});
}

TEST(LimitCurve, RefusesSchemesWithoutALimit) {
  CurveScheme<double> scheme = *find_curve_scheme("lane-riesenfeld");
  scheme.masks.point = [](const CurveSite<double>& p) { return 2 * p.point(0) - (p.point(-1) + p.point(1)) / 2; };
  expect_error<AnalysisError>([&] { LimitCurve(scheme, random_polygon(9, true)); }, {"lane-riesenfeld"});
  scheme = *find_curve_scheme("lane-riesenfeld");
  scheme.masks.point = [](const CurveSite<double>& p) {
    const double w = p.level() % 2 == 0 ? 0.125 : 0.25;
    return (1 - 2 * w) * p.point(0) + w * (p.point(-1) + p.point(1));
  };
  expect_error<AnalysisError>([&] { LimitCurve(scheme, random_polygon(9, true)); }, {"do not settle"});
}

/// Quarters of a unit circle.
ControlPolygon circle(bool closed) {
  Points points(4, 2), tangents(4, 2);
  points << 1, 0, 0, 1, -1, 0, 0, -1;
  tangents << 0, 1, -1, 0, 0, -1, 1, 0;
  ControlPolygon polygon = polygon_through(points, closed);
  polygon.tangents = tangents;
  return polygon;
}

TEST(GeometricLimitCurve, OfACircleIsTheCircle) {
  const GeometricCurveScheme scheme = *find_geometric_scheme("hermite-incentre");
  for (const bool closed : {false, true}) {
    std::vector<CurvePlace> samples;
    for (Index i = 0; i < (closed ? 4 : 3); ++i)
      for (const double t : parameters()) samples.push_back({i, t});
    const CurveSamples result = evaluate(scheme, circle(closed), samples, 2);
    for (size_t i = 0; i < samples.size(); ++i) {
      const double angle = std::numbers::pi / 2 * (samples[i].segment + samples[i].t);
      const Eigen::RowVector2d out(std::cos(angle), std::sin(angle)), along(-out[1], out[0]);
      EXPECT_NEAR((result.position.row(i) - out).norm(), 0, eigen());
      EXPECT_NEAR((result.first.row(i) - along).norm(), 0, eigen());
      EXPECT_NEAR((result.second.row(i) + out).norm(), 0, eigen());
      EXPECT_NEAR((result.normal.row(i) + out).norm(), 0, eigen());
      const bool end = !closed && (angle == 0 || samples[i].segment + samples[i].t == 3);
      EXPECT_EQ(result.status[i], end ? LimitStatus::crease : LimitStatus::regular);
    }
  }
}

TEST(GeometricLimitCurve, PassesThroughRefinedPoints) {
  const GeometricCurveScheme scheme = *find_geometric_scheme("hermite-incentre");
  for (const int dimension : {2, 3})
    for (const bool closed : {false, true}) {
      ControlPolygon polygon = polygon_through(random_points(7, dimension), closed);
      polygon.tangents = random_points(7, dimension, 8).rowwise().normalized();
      const ControlPolygon fine = refine(scheme, polygon, 6);
      std::vector<CurvePlace> samples;
      const Index legs = closed ? 7 : 6;
      for (Index i = 0; i < legs * 64; ++i) samples.push_back({i / 64, (i % 64) / 64.0});
      const CurveSamples result = evaluate(scheme, polygon, samples, 2);
      for (Index i = 0; i < legs * 64; ++i) {
        EXPECT_LT((result.position.row(i) - fine.points.row(i)).norm(), refined_arcs) << i;
        EXPECT_LT((result.first.row(i) - fine.tangents.row(i)).norm(), refined_tangents) << i;
        EXPECT_NEAR(result.second.row(i).dot(result.first.row(i)), 0, refined_arcs * (1 + result.second.row(i).norm()));
      }
      EXPECT_EQ(result.status[0], closed ? LimitStatus::unbounded_second : LimitStatus::crease);
      EXPECT_EQ(result.status[64], LimitStatus::unbounded_second);  // arcs meet
      EXPECT_EQ(result.order[64], 1);
      // The vector of curvature is the difference of tangents by length.
      const double h = difference_step;
      const std::vector<CurvePlace> three{{1, 0.2 - h}, {1, 0.2}, {1, 0.2 + h}};
      const CurveSamples near = evaluate(scheme, polygon, three, 2);
      const double length = (near.position.row(2) - near.position.row(0)).norm();
      EXPECT_LT(((near.first.row(2) - near.first.row(0)) / length - near.second.row(1)).norm(),
                difference_error * (1 + std::pow(near.second.row(1).norm(), 3)));
    }
}

TEST(GeometricLimitCurve, RefusesPlacesThatDoNotExist) {
  const GeometricCurveScheme scheme = *find_geometric_scheme("hermite-incentre");
  const auto at = [&](CurvePlace place) {
    const std::vector<CurvePlace> samples{{0, 0}, place};
    evaluate(scheme, circle(false), samples, 1);
  };
  expect_error<InvalidParameter>([&] { at({3, 0}); }, {"sample 1", "segment 3", "0 to 2"});
  expect_error<InvalidParameter>([&] { at({0, 2}); }, {"sample 1", "t is 2"});
}

}  // namespace
}  // namespace sublimit::testing
