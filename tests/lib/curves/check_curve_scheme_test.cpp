// SPDX-License-Identifier: Apache-2.0
// Curve schemes of one's own are checked before anything is computed with them.
#include "sublimit/curves/detail/check_curve_scheme.h"

#include <gtest/gtest.h>

#include "sublimit/curves/limit_curve.h"
#include "sublimit/curves/schemes/curve_ends.h"
#include "sublimit/curves/detail/curve_layout.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

CurveScheme<double> own() {
  return {.name = "own",
          .source = "here",
          .masks = {.point = [](const CurveSite<double>& p) { return (p.point(-1) + 6 * p.point(0) + p.point(1)) / 8; },
                    .edge = [](const CurveSite<double>& p) { return (p.point(0) + p.point(1)) / 2; }},
          .ends = reflected_ends<double>(),
          .claims = {}};
}

ControlPolygon polygon(bool closed) {
  ControlPolygon p;
  p.points.resize(5, 2);
  p.points << 0, 0, 1, 2, 3, 1, 4, 4, 0, 3;
  p.curves.push_back({.points = {0, 1, 2, 3, 4}, .closed = closed});
  return p;
}

void expect_refused(const CurveScheme<double>& scheme, std::initializer_list<std::string_view> parts) {
  for (const bool closed : {false, true}) {
    expect_error<InvalidParameter>([&] { refine(scheme, polygon(closed), 2); }, parts);
    expect_error<InvalidParameter>([&] { LimitCurve(scheme, polygon(closed)); }, parts);
  }
}

TEST(CheckedCurveSchemes, OwnOnesAreTaken) {
  EXPECT_NO_THROW(LimitCurve(own(), polygon(false)));
  for (const CurveScheme<double>& scheme : all_curve_schemes()) EXPECT_NO_THROW(check_scheme(scheme)) << scheme.name;
}

TEST(CheckedCurveSchemes, HaveTheirMasks) {
  CurveScheme<double> scheme = own();
  scheme.masks.point = {};
  expect_refused(scheme, {"own lacks the mask point"});
  scheme = own();
  scheme.masks.edge = {};
  expect_refused(scheme, {"own lacks the mask edge"});
  scheme = own();
  scheme.masks.before = scheme.masks.point;
  expect_refused(scheme, {"own lacks the mask after"});
  scheme.masks.after = scheme.masks.point;
  expect_refused(scheme, {"own has masks of a dual scheme (before, after) and of a primal one"});
  scheme = own();
  scheme.masks.edge_derivative = scheme.masks.edge;
  expect_refused(scheme, {"own lacks the mask point_derivative"});
}

TEST(CheckedCurveSchemes, HaveAffineMasks) {
  CurveScheme<double> scheme = own();
  scheme.masks.edge = [](const CurveSite<double>& p) { return p.point(0) + p.point(1) / 10; };
  expect_refused(scheme, {"own.edge: the weights of points add up to 1.1"});
  scheme.masks.edge = [](const CurveSite<double>&) { return Stencil<double>(); };
  expect_refused(scheme, {"own.edge returns no points"});
  scheme.masks.edge = [](const CurveSite<double>& p) { return p.derivative(0); };
  expect_refused(scheme, {"derivative", "Hermite"});
  CurveScheme<double> hermite = *find_curve_scheme("hermite-merrien");
  hermite.masks.edge_derivative = hermite.masks.edge;
  expect_error<InvalidParameter>([&] { CurveLayout layout(hermite); },
                                 {"hermite-merrien.edge_derivative", "those of a derivative to 0"});
}

TEST(CheckedCurveSchemes, HaveEndsThatUseTheCurvesPoints) {
  CurveScheme<double> scheme = own();
  scheme.masks.edge = [](const CurveSite<double>& p) {  // looks beyond the ends
    return (9 * (p.point(0) + p.point(1)) - p.point(-1) - p.point(2)) / 16;
  };
  EXPECT_NO_THROW(refine(scheme, polygon(false), 1));
  scheme.ends.beyond = [](const CurveEnd<double>& end, int) { return end.point(-1); };
  expect_error<InvalidParameter>([&] { refine(scheme, polygon(false), 1); }, {"point -1", "0 to 4 exist"});
  scheme.ends.beyond = [](const CurveEnd<double>& end, int) { return end.point(0) + end.point(1); };
  expect_error<InvalidParameter>([&] { refine(scheme, polygon(false), 1); }, {"own.edge", "add up to"});
}

TEST(CurveLevels, HaveTheLimitsOfTheirSchemeAlone) {
  const CurveScheme<double> four = *find_curve_scheme("four-point"), spline = *find_curve_scheme("lane-riesenfeld"),
                            tense = *find_curve_scheme("four-point", {{"tension", "1/2"}});
  const std::vector<CurveLevel> levels = refine(four, polygon(false), 2);
  for (const CurveLevel& level : levels) {
    EXPECT_NO_THROW(LimitCurve(*find_curve_scheme("four-point"), level));
    expect_error<InvalidParameter>([&] { LimitCurve(spline, level); }, {"'lane-riesenfeld'", "'four-point'"});
    expect_error<InvalidParameter>([&] { LimitCurve(tense, level); }, {"'four-point'", "other masks or ends"});
  }
}

}  // namespace
}  // namespace sublimit::testing
