// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/hermite_incentre.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sublimit/core/detail/dense_decompositions.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
const GeometricCurveScheme scheme = hermite_incentre({});

/// Of arcs and refined points, relative to the curve's size: about 40 roundings in 15 levels.
constexpr double curve_tolerance = 1e-14;
/// The same of curves mapped, turned or reversed: their points are rounded before the first step, relative to their
/// size.
constexpr double moved_points = 1e-12, moved_tangents = 10 * moved_points;
/// Of lengths that were divided by themselves.
const double unit_length = rounding(1);
/// Of angles of segments 2^-15 long, whose direction is a difference of points.
constexpr double short_segment_angle = 0x1p15 * 2 * eps;
/// Of differences over h: half the curvature times h, at most 6 of them.
constexpr double difference_step = 1e-4, difference_error = difference_step / 100;

Vector3d direction(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

/// Rows x,y,angle of the tangent.
ControlPolygon plane_curve(const std::vector<std::array<double, 3>>& rows, bool closed = false) {
  Points points(rows.size(), 2);
  for (size_t i = 0; i < rows.size(); ++i) points.row(i) << rows[i][0], rows[i][1];
  ControlPolygon polygon = polygon_through(points, closed);
  polygon.tangents.resize(points.rows(), 2);
  for (size_t i = 0; i < rows.size(); ++i) polygon.tangents.row(i) = direction(rows[i][2]).head<2>();
  return polygon;
}

/// One segment of length 1 whose tangents have these signed angles with it.
ControlPolygon segment(double sigma, double tau) { return plane_curve({{0, 0, sigma}, {1, 0, tau}}); }

/// Seeded curves of every kind: gentle and wild, plane and space, far from the origin.
std::vector<ControlPolygon> random_curves() {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<ControlPolygon> curves;
  for (int n = 0; n < 300; ++n) {
    const int dimension = 2 + n % 2, size = 2 + n % 9;
    Points points(size, dimension), tangents(size, dimension);
    for (double& x : points.reshaped()) x = normal(random) + (n % 5 == 0 ? 10 : 0);
    for (double& x : tangents.reshaped()) x = normal(random);
    curves.push_back(polygon_through(points, n % 3 == 0));
    curves.back().tangents = tangents.rowwise().normalized();
    curves.back() = scheme.checked(curves.back());
  }
  return curves;
}

/// A convex closed curve: points of an ellipse with tangents turned a little from its own.
ControlPolygon convex_curve(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.1, 0.9);
  std::vector<std::array<double, 3>> rows;
  for (int i = 0; i < size; ++i) {
    const double p = 2 * pi * (i + 0.4 * share(random)) / size;
    rows.push_back({3 * std::cos(p), std::sin(p), 0});
  }
  for (int i = 0; i < size; ++i) {  // a tangent between the segments before and after
    const auto angle = [&](int a, int b) {
      return std::atan2(rows[b % size][1] - rows[a % size][1], rows[b % size][0] - rows[a % size][0]);
    };
    const double before = angle(i + size - 1, i), turn = std::remainder(angle(i, i + 1) - before, 2 * pi);
    rows[i][2] = before + share(random) * turn;
  }
  return plane_curve(rows, true);
}

double size_of_limit(const ControlPolygon& polygon) { return diagonal(scheme.limit(polygon, 4).points); }

void expect_close(const ControlPolygon& a, const ControlPolygon& b, double position, double tangent) {
  ASSERT_EQ(a.num_points(), b.num_points());
  EXPECT_LE((a.points - b.points).rowwise().norm().maxCoeff(), position);
  EXPECT_LE((a.tangents - b.tangents).rowwise().norm().maxCoeff(), tangent);
}

TEST(HermiteIncentre, NewPointIsTheIncentre) {
  // P = (0,0), Q = (1,0) under 40 and 60 degrees: C by the law of sines, N from the side lengths.
  const double alpha = 2 * pi / 9, beta = pi / 3, b = std::sin(beta) / std::sin(alpha + beta),
               a = std::sin(alpha) / std::sin(alpha + beta);
  const Vector3d C = b * direction(alpha), N = (a * Vector3d::Zero() + b * Vector3d::UnitX() + C) / (a + b + 1);
  const ControlPolygon child = scheme.refine(segment(alpha, -beta));
  EXPECT_LE((child.points.row(1) - N.head<2>().transpose()).norm(), rounding(4));
  EXPECT_EQ(child.tangents.row(1), Eigen::RowVector2d(1, 0));
}

TEST(HermiteIncentre, LimitIsThoseArcsToTheLastDigits) {
  std::vector<ControlPolygon> curves = random_curves();
  for (unsigned seed = 0; seed < 20; ++seed) curves.push_back(convex_curve(3 + seed, seed));
  for (size_t n = 0; n < curves.size(); ++n) {
    SCOPED_TRACE(n);
    const int levels = n % 20 == 0 ? 15 : 8;
    expect_close(refine(scheme, curves[n], levels), scheme.limit(curves[n], levels),
                 curve_tolerance * (size_of_limit(curves[n]) + curves[n].points.cwiseAbs().maxCoeff()),
                 curve_tolerance);
  }
}

TEST(HermiteIncentre, CirclesStay) {
  for (const double turn :
       {1e-7, 0.1, 1.0, pi, 5.0, 6.0})  // one segment: less than half, half, more than half a circle
    for (const double x0 : {0.0, 100.0}) {
      SCOPED_TRACE(turn);
      const auto at = [&](double p) { return std::array{x0 + std::sin(p), -std::cos(p), p}; };
      const ControlPolygon curve = refine(scheme, plane_curve({at(0), at(turn)}), 6);
      // Rounded ends move a circle by their rounding over its sagitta, along its chord's perpendicular bisector.
      const double tolerance = curve_tolerance * (1 + x0) * (1 + 1 / std::abs(std::sin(turn / 2)));
      for (Index i = 0; i < curve.num_points(); ++i) {
        const auto [x, y, p] = at(turn * i / 64);
        EXPECT_NEAR(curve.points(i, 0), x, tolerance);
        EXPECT_NEAR(curve.points(i, 1), y, tolerance);
        EXPECT_LE((curve.tangents.row(i) - direction(p).head<2>().transpose()).norm(), 8 * unit_length + tolerance);
      }
    }
}

TEST(HermiteIncentre, AnglesHalveOnConvexCurves) {
  const ControlPolygon start = convex_curve(7, 3);
  const auto largest_angle = [](const ControlPolygon& curve) {
    double angle = 0;
    const std::vector<Index>& points = curve.curves[0].points;
    for (size_t i = 0; i < points.size(); ++i) {
      const Index a = points[i], b = points[(i + 1) % points.size()];
      const Eigen::RowVectorXd chord = (curve.points.row(b) - curve.points.row(a)).normalized();
      for (const Index end : {a, b})
        angle = std::max(angle, 2 * std::asin((chord - curve.tangents.row(end)).norm() / 2));
    }
    return angle;
  };
  const double first = largest_angle(start);
  ControlPolygon curve = start;
  for (int k = 1; k <= 10; ++k) {
    curve = scheme.refine(curve);
    EXPECT_NEAR(largest_angle(curve), std::ldexp(first, -k), short_segment_angle);
  }
}

TEST(HermiteIncentre, LimitIsGeometricallySmooth) {
  for (const ControlPolygon& polygon : random_curves())
    for (const std::vector<SegmentLimit>& segments : incentre_limit(polygon))
      for (const SegmentLimit& limit : segments)
        for (size_t i = 0; i < limit.arcs.size(); ++i) {
          const CircularArc& arc = limit.arcs[i];
          if (i > 0) {
            EXPECT_EQ(arc.start().position, limit.arcs[i - 1].end().position);
            EXPECT_EQ(arc.start().tangent, limit.arcs[i - 1].end().tangent);
          }
          // The formulas run into the stored ends, and are circles run through at constant speed.
          const double tiny = 0x1p-40, near = 1e-11 * arc.length() + rounding(8, 20);
          EXPECT_LE((arc.at(tiny).position - arc.start().position).norm(), near);
          EXPECT_LE((arc.at(1 - tiny).position - arc.end().position).norm(), near);
          EXPECT_LE((arc.at(tiny).tangent - arc.start().tangent).norm(), 100 * tiny);
          EXPECT_LE((arc.at(1 - tiny).tangent - arc.end().tangent).norm(), 100 * tiny);
          for (const double x : {0.1, 0.4, 0.9}) {
            const double h = difference_step;
            const Vector3d d = (arc.at(x + h).position - arc.at(x - h).position) / (2 * h);
            EXPECT_LE((d / arc.length() - arc.at(x).tangent).norm(), difference_error);
            EXPECT_NEAR((arc.at(x).position - arc.centre()).norm() / arc.radius(), 1,
                        moved_points * (1 + 20 / arc.length()));
          }
        }
}

TEST(HermiteIncentre, CurvatureIsThatOfTheCircle) {
  // Counter-clockwise quarter of radius 2, then clockwise; two arcs through the incentre otherwise.
  EXPECT_NEAR(incentre_limit(plane_curve({{2, 0, pi / 2}, {0, 2, pi}}))[0][0].curvature(0.3), 0.5, rounding(4));
  EXPECT_NEAR(incentre_limit(plane_curve({{0, 2, 0}, {2, 0, -pi / 2}}))[0][0].curvature(0.3), -0.5, rounding(4));
  const SegmentLimit limit = incentre_limit(segment(0.4, -0.9))[0][0];
  ASSERT_EQ(limit.arcs.size(), 2u);
  EXPECT_EQ(limit.kind, SegmentKind::convex);
  EXPECT_EQ(limit.curvature(0.1), limit.curvature(0.4));
  EXPECT_EQ(limit.curvature(0.6), limit.curvature(1));
  EXPECT_NE(limit.curvature(0.1), limit.curvature(0.6));
  EXPECT_TRUE(incentre_limit(segment(0, 0))[0][0].arcs[0].straight());
  EXPECT_EQ(incentre_limit(segment(0, 0))[0][0].at(0.25).position, Vector3d(0.25, 0, 0));
}

TEST(HermiteIncentre, FallbackIsTheBiarcOfEqualChords) {
  struct Case {
    double sigma, tau;
    SegmentKind kind;
  };
  for (const auto& [sigma, tau, kind] :
       {Case{0.7, 0.3, SegmentKind::inflection}, Case{0.5, 0.5, SegmentKind::inflection},
        Case{-2.5, -3, SegmentKind::inflection}, Case{0.8, 0, SegmentKind::inflection},
        Case{0, -0.8, SegmentKind::inflection}, Case{0.6, -1e-9, SegmentKind::inflection}}) {
    SCOPED_TRACE(std::to_string(sigma) + " " + std::to_string(tau));
    const SegmentStep step = incentre_step({{0, 0, 0}, direction(sigma)}, {{1, 0, 0}, direction(tau)}, 1);
    EXPECT_EQ(step.kind, kind);
    const Vector3d expected(0.5, std::tan((sigma - tau) / 4) / 2, 0);
    EXPECT_LE((step.point.position - expected).norm(), rounding(4));
    EXPECT_LE((step.point.tangent - direction(-(sigma + tau) / 2)).norm(), rounding(4));
  }
  EXPECT_EQ(incentre_limit(segment(pi, -pi))[0][0].kind, SegmentKind::back);
  EXPECT_EQ(incentre_limit(segment(pi, -pi))[0][0].arcs.size(), 4u);
  EXPECT_EQ(incentre_limit(segment(pi, 0))[0][0].arcs.size(), 2u);
  const SegmentStep twisted =
      incentre_step({{0, 0, 0}, Vector3d(1, 1, 0).normalized()}, {{1, 0, 0}, Vector3d(1, 0, 1).normalized()}, 1);
  EXPECT_EQ(twisted.kind, SegmentKind::twisted);
  EXPECT_EQ(scheme.notes(segment(0.4, -0.9)).size(), 0u);
  EXPECT_NE(scheme.notes(segment(0.4, 0.9)).at(0).find("1 of 1 segments"), std::string::npos);
}

TEST(HermiteIncentre, SimilaritiesAndReversalCommute) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const ControlPolygon& polygon : random_curves()) {
    const int d = polygon.dimension();
    const double factor = std::exp(3 * normal(random)), size = size_of_limit(polygon) + 20;
    Eigen::MatrixXd A(d, d);
    for (double& x : A.reshaped()) x = normal(random);
    const Eigen::MatrixXd Q = orthonormal_columns(A);  // reflections among them
    Eigen::RowVectorXd shift(d);
    for (double& x : shift) x = factor * normal(random);
    const auto moved = [&](ControlPolygon p) {
      p.points = ((factor * p.points * Q).rowwise() + shift).eval();
      p.tangents = (p.tangents * Q).eval();
      return p;
    };
    // Positions move with the tangents' rounding times the size of the arcs, which turn back near 2 pi.
    expect_close(scheme.limit(scheme.checked(moved(polygon)), 4), moved(scheme.limit(polygon, 4)),
                 moved_points * factor * size * size, moved_tangents * size);

    ControlPolygon back = polygon;
    std::reverse(back.curves[0].points.begin(), back.curves[0].points.end());
    back.tangents = -back.tangents;
    ControlPolygon limit = scheme.limit(back, 4);
    limit.tangents = -limit.tangents;
    const ControlPolygon forward = scheme.limit(polygon, 4);
    // Closed curves begin at the other end: their last segment comes last both ways, from the first point backwards.
    const Index n = forward.num_points(), last = polygon.curves[0].closed ? n - 16 : n - 1;
    for (Index i = 0; i < n; ++i) {
      const Index j = ((last - i) % n + n) % n;
      EXPECT_LE((limit.points.row(i) - forward.points.row(j)).norm(), moved_points * size * size);
      EXPECT_LE((limit.tangents.row(i) - forward.tangents.row(j)).norm(), moved_tangents * size);
    }
  }
}

TEST(HermiteIncentre, OldDataStayAndTangentsStayUnits) {
  for (const ControlPolygon& polygon : random_curves()) {
    const ControlPolygon child = refine(scheme, polygon, 3), limit = scheme.limit(polygon, 3);
    for (Index i = 0; i < polygon.num_points(); ++i)
      for (const ControlPolygon* fine : {&child, &limit}) {
        EXPECT_EQ(fine->points.row(8 * i), polygon.points.row(i));
        EXPECT_EQ(fine->tangents.row(8 * i), polygon.tangents.row(i));
      }
    EXPECT_LE((child.tangents.rowwise().norm().array() - 1).abs().maxCoeff(), unit_length);
    const ControlPolygon twice = refine(scheme, refine(scheme, polygon, 1), 2);
    EXPECT_EQ(twice.points, child.points);
    EXPECT_EQ(twice.tangents, child.tangents);
  }
}

TEST(HermiteIncentre, EveryPairOfAnglesConverges) {
  // Also zero, right, opposite, nearly so; in the plane and twisted out of it. Points close up, nothing runs away.
  const double angles[] = {0, 1e-16, 1e-9, 1e-5, 0.3, pi / 2, 2, pi - 0.01, pi - 1e-5, pi - 1e-9, pi};
  for (const double a : angles)
    for (const double b : angles)
      for (const int sign : {1, -1})
        for (const double twist : {0.0, 1e-15, 1e-9, 0.1, pi / 2, pi}) {
          SCOPED_TRACE(std::to_string(a) + " " + std::to_string(sign * b) + " " + std::to_string(twist));
          const Eigen::AngleAxisd turn(twist, Vector3d::UnitX());
          ControlPolygon curve = polygon_through(Points{{0, 0, 0}, {1, 0, 0}});
          curve.tangents.resize(2, 3);
          curve.tangents.row(0) = direction(a);
          curve.tangents.row(1) = turn * direction(sign * b);
          const ControlPolygon fine = scheme.limit(scheme.checked(curve), 10);
          ASSERT_TRUE(fine.points.allFinite() && fine.tangents.allFinite());
          const double size = diagonal(fine.points);
          EXPECT_LE(size, 500);
          for (Index i = 0; i + 1 < fine.num_points(); ++i)
            EXPECT_LE((fine.points.row(i + 1) - fine.points.row(i)).norm(), 0.02 * size);
        }
}

TEST(HermiteIncentre, ThousandsOfConvexLegs) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const ControlPolygon polygon = convex_curve(2000, seed), fine = refine(scheme, polygon, 5);
    EXPECT_TRUE(fine.points.allFinite());
    EXPECT_EQ(scheme.notes(polygon).size(), 0u);
    EXPECT_EQ(fine.num_points(), 64000);
    expect_close(fine, scheme.limit(polygon, 5), 5 * curve_tolerance, 5 * curve_tolerance);
  }
}

TEST(HermiteIncentre, RefusesWhatItCannotTake) {
  const auto refused = [](ControlPolygon polygon, std::initializer_list<std::string_view> parts) {
    expect_error<InvalidMesh>([&] { refine(scheme, polygon, 1); }, parts);
  };
  ControlPolygon polygon = plane_curve({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}});
  refused(polygon, {"points 1 and 2", "equal"});
  polygon = plane_curve({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, true);
  refused(polygon, {"points 2 and 0", "closed"});
  polygon.tangents.row(1) *= 2;
  refused(polygon, {"tangent of point 1 has length 2", "length 1"});
  polygon.tangents.row(1).setConstant(std::nan(""));
  refused(polygon, {"point 1", "not finite"});
  polygon.tangents.resize(0, 0);
  refused(polygon, {"without tangents", "x,y,tx,ty"});
  expect_error<UnsupportedTopology>([] { refine(scheme, plane_curve({{0, 0, 0}}), 1); }, {"1 point", "at least 2"});
  expect_error<InvalidParameter>([] { refine(scheme, segment(1, -1), -1); }, {"-1"});
  // Almost units are made units.
  polygon = segment(1, -1);
  polygon.tangents *= 1 + 1e-7;
  EXPECT_NEAR(scheme.checked(polygon).tangents.row(0).norm(), 1, unit_length);
}

}  // namespace
}  // namespace sublimit::testing
