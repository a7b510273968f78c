// SPDX-License-Identifier: Apache-2.0
// Random rational curves and surfaces, closed ones included, against OpenCASCADE.
#include <gtest/gtest.h>

#include <random>

#include "peers/opencascade_reference.h"
#include "sublimit/patches/detail/spline_rows.h"
#include "sublimit/patches/spline_curve.h"
#include "sublimit/patches/spline_surface.h"
#include "truth/precise.h"

namespace sublimit::testing {
namespace {

Knots<double> random_knots(std::mt19937& random, int degree) {
  const auto step = [&] { return 0.25 + std::uniform_real_distribution<>(0, 1)(random); };
  if (random() % 4 == 0) {
    std::vector<double> breaks{0};
    for (auto count = static_cast<size_t>(degree) + 1 + random() % 6; count > 0; --count)
      breaks.push_back(breaks.back() + step());
    return Knots<double>::closed(degree, breaks);
  }
  // Ends clamped or not, inner knots once or several times.
  const bool clamped = random() % 2 == 0;
  std::vector<double> knots;
  double t = 0;
  for (int i = 0; i <= degree; ++i) knots.push_back(clamped || i == 0 ? t : t += step());
  for (auto inner = random() % 6; inner > 0; --inner) {
    t += step();
    knots.insert(knots.end(), 1 + random() % unsigned(degree), t);
  }
  t += step();
  for (int i = 0; i <= degree; ++i) knots.push_back(clamped || i == 0 ? t : t += step());
  return Knots<double>::open(degree, static_cast<Index>(knots.size()) - degree - 1, knots);
}

Points random_columns(std::mt19937& random, Index count) {
  Points columns(count, 4);
  for (Index i = 0; i < count; ++i) {
    const double w = std::uniform_real_distribution<>(0.3, 3)(random);
    for (int c = 0; c < 3; ++c) columns(i, c) = w * std::uniform_real_distribution<>(-1, 1)(random);
    columns(i, 3) = w;
  }
  return columns;
}

double inside(std::mt19937& random, const Knots<double>& knots) {
  return std::uniform_real_distribution<>(knots.begin(), knots.end())(random);
}

/// Point and two derivatives of a rational curve in 256 bits.
CurveDerivatives precise_derivatives(const Knots<double>& knots, const Points& columns, const CurvePlace& place,
                                     double t) {
  const int degree = knots.degree();
  const auto precise = Knots<Precise>::open(degree, knots.num_functions(), {knots.all().begin(), knots.all().end()});
  const Index span = precise.span(place.segment);
  const Precise from = precise.all()[size_t(span)], length = precise.length(place.segment);
  std::vector<Precise> rows(3 * size_t(degree + 1));
  span_rows(precise, place.segment, Precise((Precise(t) - from) / length), 2, std::span(rows));
  Precise of[3][4];
  for (int r = 0; r <= 2; ++r)
    for (int i = 0; i <= degree; ++i) {
      const Index row = knots.point(span - degree + i);
      const Precise weight = rows[size_t(r) * size_t(degree + 1) + size_t(i)] / pow(length, r);
      for (int c = 0; c < 4; ++c) of[r][c] += weight * Precise(columns(row, c));
    }
  CurveDerivatives result;
  for (int c = 0; c < 3; ++c) {
    const Precise x = of[0][c] / of[0][3], first = (of[1][c] - of[1][3] * x) / of[0][3];
    const Precise second = (of[2][c] - 2 * of[1][3] * first - of[2][3] * x) / of[0][3];
    result[0][c] = static_cast<double>(x);
    result[1][c] = static_cast<double>(first);
    result[2][c] = static_cast<double>(second);
  }
  return result;
}

/// Largest error of a point, and of its derivatives beside 1 + their size.
void expect_near(const CurveDerivatives& is, const CurveDerivatives& right, double tolerance, const char* whose,
                 int trial) {
  EXPECT_LE((is[0] - right[0]).norm(), tolerance) << whose << ", trial " << trial;
  EXPECT_LE((is[1] - right[1]).norm(), 10 * tolerance * (1 + right[1].norm())) << whose << ", trial " << trial;
  EXPECT_LE((is[2] - right[2]).norm(), 100 * tolerance * (1 + right[2].norm())) << whose << ", trial " << trial;
}

TEST(OpenCascade, CurvesAreOurs) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const SplineCurve curve(random_knots(random, 1 + trial % 9));
    const Points columns = random_columns(random, curve.num_points());
    std::vector<double> parameters;
    std::vector<CurvePlace> places;
    for (int i = 0; i < 20; ++i) {
      parameters.push_back(inside(random, curve.knots()));
      places.push_back(curve.place(parameters.back()));
    }
    const CurveSamples ours = curve.evaluate(columns, places, 2, Coordinates::homogeneous);
    const std::vector<CurveDerivatives> theirs = opencascade_curve(curve.knots(), columns, parameters);
    for (size_t i = 0; i < places.size(); ++i) {
      const double h = curve.knots().length(places[i].segment);
      const auto row = static_cast<Eigen::Index>(i);
      const CurveDerivatives is = {ours.position.row(row), ours.first.row(row) / h, ours.second.row(row) / (h * h)};
      expect_near(is, precise_derivatives(curve.knots(), columns, places[i], parameters[i]), 1e-14, "ours", trial);
      // Their own error grows with the degree, to 8e-13 of degree 9 (256 bits say so).
      expect_near(is, theirs[i], curve.knots().degree() <= 5 ? 1e-13 : 4e-12, "theirs", trial);
    }
  }
}

TEST(OpenCascade, SurfacesAreOurs) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const SplineSurface surface(random_knots(random, 1 + trial % 5), random_knots(random, 1 + int(random() % 5)));
    const Points columns = random_columns(random, surface.num_points());
    std::vector<Patch::Parameters> parameters;
    std::vector<Place> places;
    for (int i = 0; i < 20; ++i) {
      parameters.push_back({.u = inside(random, surface.u()), .v = inside(random, surface.v())});
      places.push_back(surface.place(parameters.back()));
    }
    const LimitSamples ours = surface.evaluate(columns, places, 2, Coordinates::homogeneous);
    const std::vector<SurfaceDerivatives> theirs = opencascade_surface(surface.u(), surface.v(), columns, parameters);
    const Points* const matrices[] = {&ours.position, &ours.du, &ours.dv, &ours.duu, &ours.duv, &ours.dvv};
    for (size_t i = 0; i < places.size(); ++i) {
      const auto [u, v] = surface.lengths(places[i].face);
      const double scales[] = {1, u, v, u * u, u * v, v * v};
      constexpr double of_order[] = {1e-13, 1e-12, 1e-11};  // each divides by lengths of spans once more
      for (size_t k = 0; k < 6; ++k) {
        const Eigen::Vector3d x = matrices[k]->row(Eigen::Index(i)) / scales[k];
        EXPECT_LE((x - theirs[i][k]).norm(), of_order[k < 1   ? 0
                                                      : k < 3 ? 1
                                                              : 2] *
                                                 (1 + theirs[i][k].norm()))
            << trial << ", derivative " << k;
      }
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
