// SPDX-License-Identifier: Apache-2.0
// Joints of the curves of a file: at their knots and end to end, each as it was made.
#include "sublimit/report/free_form/free_form_joints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using std::numbers::pi;

/// What is between doubles of size 1 after a few products.
constexpr double few_products = 1e-14;

std::vector<CurveBezier> curves_in(const std::string& text, FreeForm* shapes = nullptr) {
  const FreeForm parsed = parse_free_form(text, "curves.obj");
  std::vector<CurveBezier> curves;
  for (const FreeFormCurve& curve : parsed.curves) curves.push_back(curve_bezier(parsed, curve));
  if (shapes != nullptr) *shapes = parsed;
  return curves;
}

FreeFormJoints joints_in(const std::string& text) { return free_form_joints(curves_in(text), 1e-6, 1e-3); }

std::string bezier(int degree, const std::string& points, const std::string& parm = "0 1") {
  return "cstype bezier\ndeg " + std::to_string(degree) + "\ncurv 0 1 " + points + "\nparm u " + parm + "\nend\n";
}

TEST(FreeFormJoints, KnotsOfAUniformCubicAreC2AndNoMore) {
  const FreeFormJoints found = joints_in(
      "v 0 0 0\nv 1 2 0\nv 2 -1 1\nv 3 0 0\nv 4 1 0\nv 5 5 2\ncstype bspline\ndeg 3\ncurv 3 6 1 2 3 4 5 6\n"
      "parm u 0 1 2 3 4 5 6 7 8 9\nend\n");
  ASSERT_EQ(found.joints.size(), 2u);
  EXPECT_EQ(found.free_ends, 2u);
  for (size_t i = 0; i < 2; ++i) {
    const FreeFormJoint& joint = found.joints[i];
    EXPECT_EQ(joint.kind, FreeFormJoint::Kind::knot);
    EXPECT_EQ(joint.left_parameter, 4 + double(i));
    EXPECT_EQ(joint.measured.orders.c, 2);
    EXPECT_EQ(joint.measured.orders.g, 2);
    ASSERT_TRUE(joint.exact);
    EXPECT_EQ(*joint.exact, joint.measured.orders);
  }
}

TEST(FreeFormJoints, ARightAngleAndAStraightContinuation) {
  const FreeFormJoints found = joints_in("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 3 0 0\n" + bezier(1, "1 2") + bezier(1, "2 3"));
  ASSERT_EQ(found.joints.size(), 1u);
  const FreeFormJoint& corner = found.joints[0];
  EXPECT_EQ(corner.kind, FreeFormJoint::Kind::ends);
  EXPECT_EQ(corner.left, 0u);
  EXPECT_EQ(corner.right, 1u);
  EXPECT_FALSE(corner.left_reversed || corner.right_reversed);
  EXPECT_EQ(*corner.exact, (JoinOrders{0, 0, false, JoinObstacle::angle}));
  EXPECT_NEAR(corner.measured.angle.value(), pi / 2, few_products);
  EXPECT_EQ(corner.place, Eigen::Vector3d(1, 0, 0));
  // Twice as fast on the same line: every G^k that is looked for, C^0.
  const FreeFormJoints straight = joints_in("v 0 0 0\nv 1 0 0\nv 3 0 0\n" + bezier(1, "1 2") + bezier(1, "3 2"));
  ASSERT_EQ(straight.joints.size(), 1u);
  EXPECT_TRUE(straight.joints[0].right_reversed);
  EXPECT_EQ(straight.joints[0].exact->c, 0);
  EXPECT_EQ(straight.joints[0].exact->g, 3);
  EXPECT_NEAR(straight.joints[0].measured.ratios.at(0), 2, few_products);
}

TEST(FreeFormJoints, ACircleAndItsTangentDifferInCurvature) {
  // A quarter of the unit circle from (1, 0) to (0, 1), then a line to (-1, 1): curvature 1 and 0.
  const std::string circle =
      "v 1 0 0\nv 1 1 0 0.5\nv 0 1 0 0.5\nv -1 1 0\ncstype rat bezier\ndeg 2\ncurv 0 1 1 2 3\nparm u 0 1\nend\n";
  // Weights 1, 1/2, 1/2: a circle needs w_1^2 = w_0 w_2/2.
  const FreeFormJoints found = joints_in(circle + bezier(1, "3 4"));
  ASSERT_EQ(found.joints.size(), 1u);
  const FreeFormJoint& joint = found.joints[0];
  EXPECT_EQ(joint.exact->g, 1);
  EXPECT_EQ(joint.exact->obstacle, JoinObstacle::curvature);
  EXPECT_NEAR(joint.measured.curvature_jump.value(), 1, few_products);
  EXPECT_NEAR(joint.greatest_curvature, 1, few_products);
}

TEST(FreeFormJoints, EndsOfEveryDirectionMeet) {
  // One parabola in two halves, each either way round: (0,0), (1,2), (2,0) cut at its top (1,1).
  const std::string points = "v 0 0 0\nv 0.5 1 0\nv 1 1 0\nv 1.5 1 0\nv 2 0 0\n";
  for (const char* left : {"1 2 3", "3 2 1"})
    for (const char* right : {"3 4 5", "5 4 3"}) {
      const FreeFormJoints found = joints_in(points + bezier(2, left) + bezier(2, right));
      ASSERT_EQ(found.joints.size(), 1u) << left << "; " << right;
      EXPECT_EQ(found.joints[0].exact->c, 2) << left << "; " << right;
      EXPECT_TRUE(found.joints[0].exact->is_same);
      EXPECT_EQ(found.free_ends, 2u);
    }
}

TEST(FreeFormJoints, AClosedCurveMeetsItself) {
  const FreeFormJoints found = joints_in("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + bezier(3, "1 2 3 1"));
  ASSERT_EQ(found.joints.size(), 1u);
  EXPECT_EQ(found.joints[0].left, found.joints[0].right);
  // It arrives along -y and leaves along x.
  EXPECT_NEAR(found.joints[0].measured.angle.value(), pi / 2, few_products);
  EXPECT_EQ(found.free_ends, 0u);
}

TEST(FreeFormJoints, GapsAndBranchesAreSaid) {
  const FreeFormJoints gap =
      joints_in("v 0 0 0\nv 1 0 0\nv 1.0005 0 0\nv 2 0 0\n" + bezier(1, "1 2") + bezier(1, "3 4"));
  ASSERT_EQ(gap.joints.size(), 1u);
  EXPECT_NEAR(gap.joints[0].measured.gap, 0.0005, few_products);
  EXPECT_EQ(gap.joints[0].measured.orders.g, -1);
  const FreeFormJoints branch =
      joints_in("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\n" + bezier(1, "1 2") + bezier(1, "2 3") + bezier(1, "2 4"));
  EXPECT_TRUE(branch.joints.empty());
  EXPECT_EQ(branch.branches, 1u);
  EXPECT_EQ(branch.free_ends, 3u);
}

TEST(FreeFormJoints, OtherBasesAreMeasured) {
  // Catmull-Rom: C^1. Taylor pieces x = t, y = t^2 and then x = 1 + t, y = 1 + 3 t: a corner, tangents 2 and 3.
  const FreeFormJoints rom = joints_in(
      "v 0 0 0\nv 1 2 0\nv 2 -1 0\nv 3 4 0\nv 5 5 0\ncstype cardinal\ndeg 3\ncurv 0 2 1 2 3 4 5\nparm u 0 1 2\nend\n");
  ASSERT_EQ(rom.joints.size(), 1u);
  EXPECT_FALSE(rom.joints[0].exact);
  EXPECT_EQ(rom.joints[0].measured.orders.c, 1);
  const FreeFormJoints taylor = joints_in(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 1 3 0\nv 0 0 0\ncstype taylor\ndeg 2\ncurv 0 2 1 2 3 4 5 6\n"
      "parm u 0 1 2\nend\n");
  ASSERT_EQ(taylor.joints.size(), 1u);
  EXPECT_EQ(taylor.joints[0].measured.orders.g, 0);
  EXPECT_NEAR(taylor.joints[0].measured.angle.value(), std::atan(3) - std::atan(2), few_products);
}

TEST(FreeFormJoints, ThePartThatACurveMeansEndsWhereItSays) {
  // y = x^2 on [0, 1] from 1/4 to 1/2, and on from there with its tangent.
  FreeForm shapes;
  const std::vector<CurveBezier> curves = curves_in(
      "v 0 0 0\nv 0.5 0 0\nv 1 1 0\nv 0.5 0.25 0\nv 1.5 1.25 0\ncstype bezier\ndeg 2\ncurv 0.25 0.5 1 2 3\n"
      "parm u 0 1\nend\n" +
          bezier(1, "4 5"),
      &shapes);
  EXPECT_EQ(curves[0].breaks, (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(curves[0].pieces[0].length, 0.25);
  const FreeFormJoints found = free_form_joints(curves, 1e-6, 1e-3);
  ASSERT_EQ(found.joints.size(), 1u);
  EXPECT_EQ(found.joints[0].left_parameter, 0.5);
  EXPECT_EQ(*found.joints[0].exact, (JoinOrders{1, 1, false, JoinObstacle::curvature}));
  // y'' = 2, (1 + y'^2)^(3/2) = 2^(3/2).
  EXPECT_NEAR(found.joints[0].measured.curvature_jump.value(), std::sqrt(0.5), few_products);
}

}  // namespace
}  // namespace sublimit::testing
