// SPDX-License-Identifier: Apache-2.0
// C^n and G^n where pieces meet, on joints made by hand.
#include "sublimit/certificates/regularity/curve_joints.h"

#include <gtest/gtest.h>

#include <array>

#include "sublimit/base/error.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

CurveJoint joint_of(const Eigen::MatrixXd& before, const Eigen::MatrixXd& after) {
  return curve_joints({.pieces = {before, after}})[0];
}

Eigen::MatrixXd points(std::initializer_list<std::array<double, 2>> list) {
  Eigen::MatrixXd m(list.size(), 2);
  Eigen::Index i = 0;
  for (const auto& p : list) m.row(i++) << p[0], p[1];
  return m;
}

TEST(CurveJoints, UniformCubicSplinePiecesAreC2) {
  // Bezier points of the B-spline segment of p0..p3: (1,4,1)/6, (2,1)/3, (1,2)/3, (1,4,1)/6.
  const Eigen::MatrixXd p = points({{0, 0}, {1, 2}, {3, 3}, {4, -1}, {6, 0}});
  const auto segment = [&](Eigen::Index i) {
    Eigen::MatrixXd b(4, 2);
    b.row(0) = (p.row(i) + 4 * p.row(i + 1) + p.row(i + 2)) / 6;
    b.row(1) = (2 * p.row(i + 1) + p.row(i + 2)) / 3;
    b.row(2) = (p.row(i + 1) + 2 * p.row(i + 2)) / 3;
    b.row(3) = (p.row(i + 1) + 4 * p.row(i + 2) + p.row(i + 3)) / 6;
    return b;
  };
  const CurveJoint j = joint_of(segment(0), segment(1));
  EXPECT_EQ(j.c, 2);
  EXPECT_EQ(j.g, 2);
  EXPECT_FALSE(j.same_polynomial);
  EXPECT_NEAR(j.ratios[0], 1, testing::other_route);
}

/// The polar form at three parameters of the cubic spline's piece between knots j and j + 1, by de Boor's algorithm: at
/// (a, a, a), (a, a, b), (a, b, b), (b, b, b) it has the Bezier points of the piece from a to b (Ramshaw 1989).
Eigen::RowVector2d polar(const std::vector<double>& knots, Eigen::MatrixXd d, int j, std::array<double, 3> at) {
  for (int step = 1; step <= 3; ++step)
    for (int i = j; i > j - 4 + step; --i) {
      const double a = (at[step - 1] - knots[i]) / (knots[i + 4 - step] - knots[i]);
      d.row(i) = (1 - a) * d.row(i - 1) + a * d.row(i);
    }
  return d.row(j);
}

// Cubic splines are C^2 at simple knots alone, and C^(3 - r) at a knot of multiplicity r (Curry, Schoenberg 1966).
TEST(CurveJoints, SplinesLoseADerivativeWithEachKnotThatCoincides) {
  const Eigen::MatrixXd control = points({{0, 0}, {1, 2}, {3, 3}, {4, -1}, {6, 0}, {7, 2}, {9, 1}, {8, -2}});
  for (int r = 1; r <= 4; ++r) {
    std::vector<double> knots{0, 1, 2, 3};
    knots.insert(knots.end(), r, 4.0);
    knots.insert(knots.end(), {5, 6, 7, 8});
    const auto piece = [&](int j, double a, double b) {
      Eigen::MatrixXd bezier(4, 2);
      bezier << polar(knots, control, j, {a, a, a}), polar(knots, control, j, {a, a, b}),
          polar(knots, control, j, {a, b, b}), polar(knots, control, j, {b, b, b});
      return bezier;
    };
    const CurveJoint joint = joint_of(piece(3, 3, 4), piece(3 + r, 4, 5));
    EXPECT_EQ(joint.c, 3 - r) << r;
    EXPECT_FALSE(joint.same_polynomial) << r;
  }
}

TEST(CurveJoints, ReparametrisedPiecesAreGeometricallySmooth) {
  // The parabola (t, t^2): from -1 to 0, and from 0 on at twice the pace with (2 s + 3 s^2, (2 s + 3 s^2)^2), quartic.
  const Eigen::MatrixXd before = points({{-1, 1}, {-0.5, 0}, {0, 0}});
  // Monomials 2s + 3s^2 and 4s^2 + 12 s^3 + 9 s^4 in Bernstein form of degree 4.
  const Eigen::MatrixXd after = points({{0, 0}, {0.5, 0}, {1.5, 4.0 / 6}, {3, 2 + 3}, {5, 25}});
  const CurveJoint j = joint_of(before, after);
  EXPECT_EQ(j.c, 0);
  EXPECT_EQ(j.g, 4);  // all that pieces of degree 4 can show
  ASSERT_EQ(j.ratios.size(), 4u);
  EXPECT_NEAR(j.ratios[0], 2, testing::other_route);
  EXPECT_NEAR(j.ratios[1], 6, testing::other_route);
  EXPECT_NEAR(j.ratios[2], 0, testing::third_derivative);
}

TEST(CurveJoints, SignsOfTheRatiosMatterOnlyForTheTangent) {
  // Straight on but back: a cusp, although the directions are parallel.
  const CurveJoint cusp = joint_of(points({{0, 0}, {1, 0}}), points({{1, 0}, {0.5, 0}}));
  EXPECT_EQ(cusp.g, 0);
  EXPECT_EQ(cusp.ratios[0], -0.5);
  // A line whose parameter slows down: second ratio negative, and smooth as a set.
  const CurveJoint slow = joint_of(points({{0, 0}, {1, 0}}), points({{1, 0}, {1.5, 0}, {1.75, 0}}));
  EXPECT_EQ(slow.c, 1);
  EXPECT_EQ(slow.g, 2);
  EXPECT_EQ(slow.ratios[0], 1);
  EXPECT_LT(slow.ratios[1], 0);
}

TEST(CurveJoints, CornersAndGapsAreFound) {
  EXPECT_EQ(joint_of(points({{0, 0}, {1, 0}}), points({{1, 0}, {1, 1}})).g, 0);
  EXPECT_EQ(joint_of(points({{0, 0}, {1, 0}}), points({{1.1, 0}, {1, 1}})).c, -1);
  EXPECT_FALSE(joint_of(points({{0, 0}, {1, 0}, {1, 0}}), points({{1, 0}, {1, 1}})).has_tangents);
  const CurveJoint same = joint_of(points({{0, 0}, {1, 0}}), points({{1, 0}, {2, 0}}));
  EXPECT_TRUE(same.same_polynomial);
}

TEST(CurveJoints, FilesAreReadAndRefused) {
  const BezierCurve curve = read_bezier_curve("piece,x,y\n0,0,0\n0,1,0\n# next\n1,1,0\n1,2,0\nclosed\n");
  ASSERT_EQ(curve.pieces.size(), 2u);
  EXPECT_TRUE(curve.closed);
  EXPECT_EQ(curve_joints(curve).size(), 2u);
  EXPECT_THROW(read_bezier_curve("x,y\n"), FormatError);
  EXPECT_THROW(read_bezier_curve("piece,x,y\n0,0\n"), FormatError);
  EXPECT_THROW(read_bezier_curve("piece,x,y\n1,0,0\n"), FormatError);
  EXPECT_THROW(read_bezier_curve("piece,x,y\n0,0,nan\n"), FormatError);
  EXPECT_THROW(read_bezier_curve(""), FormatError);
  EXPECT_THROW(curve_joints({}), InvalidMesh);
}

}  // namespace
}  // namespace sublimit
