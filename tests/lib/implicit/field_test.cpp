// SPDX-License-Identifier: Apache-2.0
// Fields: closed forms, derivatives, curvature, extents, errors.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sublimit/implicit/detail/combinations.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const double nan = std::numeric_limits<double>::quiet_NaN();

Points square() {
  Points points(4, 3);
  points << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  return points;
}

struct Named {
  const char* name;
  FieldPointer field;
};
std::vector<Named> fields() {
  const FieldPointer a = sphere_field({0, 0, 0}, 1), b = distance_to_segment({0, 0, 0}, {1, 2, 0}, .25);
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn.topLeftCorner<3, 3>() = 2 * Eigen::AngleAxisd(.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  turn.topRightCorner<3, 1>() = Vector3d(.1, -.2, .3);
  return {{"sphere", a},
          {"point", distance_to_point({.1, .2, .3}, .5)},
          {"line", distance_to_line({0, 0, 1}, {1, 1, 0}, .5)},
          {"segment", b},
          {"plane", distance_to_plane({0, 0, 0}, {1, 2, 2}, .5)},
          {"half-space", distance_to_plane({0, 0, 0}, {1, 2, 2}, .5, true)},
          {"circle", distance_to_circle({0, 0, 0}, {0, 0, 2}, 1, .4)},
          {"polygon", distance_to_polygon(square(), .3)},
          {"box", box_field({0, 0, 0}, {1, .8, .6})},
          {"polynomial", polynomial_field({{1, 4, 0, 0}, {1, 0, 4, 0}, {1, 0, 0, 4}, {-3, 1, 1, 0}, {.5, 0, 0, 0}})},
          {"quadric", quadric_field(Eigen::Vector4d(1, 2, 3, -1).asDiagonal())},
          {"blinn", blinn_field(.5, {{{0, 0, 0}, 1, 2}, {{1, 0, 0}, -.5, 1}})},
          {"metaballs", metaballs_field(.4, {{{0, 0, 0}, 1, 1}, {{.9, 0, 0}, 1, 1.5}})},
          {"soft", soft_objects_field(.4, {{{0, 0, 0}, 1, 1}, {{.9, 0, 0}, 1, 1.5}})},
          {"union", union_field({a, b})},
          {"intersection", intersection_field({a, b})},
          {"difference", difference_field({a, b})},
          {"smooth", smooth_union_field({a, b, distance_to_point({2, 0, 0}, .3)}, .5)},
          {"offset", offset_field(b, .2)},
          {"transformed", transformed_field(b, turn)},
          {"callback", callback_field([a](const Vector3d& x) { return a->jet(x); })}};
}

/// Central differences with steps of h: the error of the formula, h^2 times third derivatives of size 100 at most on
/// these fields, and rounding eps / h.
constexpr double step = 1e-5, difference = 1e-7;

TEST(Field, DerivativesAreThoseOfTheValues) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-1.5, 1.5);
  for (const Named& named : fields()) {
    SCOPED_TRACE(named.name);
    const Field& field = *named.field;
    for (int i = 0; i < 60; ++i) {
      const Vector3d x(anywhere(random), anywhere(random), anywhere(random));
      const FieldJet jet = field.jet(x);
      EXPECT_NEAR(jet.value, field.value(x), rounding(50, 10));
      EXPECT_EQ(jet.order, 2);
      EXPECT_LE((jet.hessian - jet.hessian.transpose()).norm(), rounding(50, 1 + jet.hessian.norm()));
      for (int k = 0; k < 3; ++k) {
        const Vector3d up = x + step * Vector3d::Unit(k), down = x - step * Vector3d::Unit(k);
        const FieldJet above = field.jet(up), below = field.jet(down);
        // Not across an edge.
        if ((above.gradient - below.gradient).norm() > 1e3 * step ||
            (above.hessian - below.hessian).norm() > 1e4 * step)
          continue;
        EXPECT_NEAR((above.value - below.value) / (2 * step), jet.gradient[k], difference);
        EXPECT_LE(((above.gradient - below.gradient) / (2 * step) - jet.hessian.col(k)).norm(), 100 * difference);
      }
    }
  }
}

TEST(Field, DistancesHaveGradientsOfLengthOne) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> anywhere(-2, 2);
  for (const Named& named : fields()) {
    const std::string name = named.name;
    if (name != "point" && name != "line" && name != "segment" && name != "plane" && name != "circle" &&
        name != "polygon" && name != "offset" && name != "transformed")
      continue;
    SCOPED_TRACE(name);
    for (int i = 0; i < 50; ++i) {
      const Vector3d x(anywhere(random), anywhere(random), anywhere(random));
      EXPECT_NEAR(named.field->gradient(x).norm(), 1, reference);
    }
  }
}

TEST(Field, ValuesByHand) {
  EXPECT_EQ(sphere_field({1, 0, 0}, 2)->value({1, 3, 0}), 5);
  EXPECT_EQ(distance_to_point({0, 0, 0}, 1)->value({0, 3, 4}), 4);
  EXPECT_EQ(distance_to_line({0, 0, 5}, {0, 0, 2}, 1)->value({3, 4, 9}), 4);
  EXPECT_EQ(distance_to_segment({0, 0, 0}, {2, 0, 0}, 1)->value({5, 4, 0}), 4);
  EXPECT_EQ(distance_to_segment({0, 0, 0}, {2, 0, 0}, 1)->value({1, 4, 0}), 3);
  EXPECT_EQ(distance_to_plane({0, 0, 1}, {0, 0, 3}, .5)->value({7, 8, -2}), 2.5);
  EXPECT_EQ(distance_to_plane({0, 0, 1}, {0, 0, 3}, .5, true)->value({7, 8, -2}), -3.5);
  EXPECT_EQ(distance_to_circle({0, 0, 0}, {0, 0, 1}, 2, 1)->value({5, 0, 4}), 4);
  EXPECT_EQ(distance_to_polygon(square(), 1)->value({.5, .5, -3}), 2);
  EXPECT_EQ(distance_to_polygon(square(), 1)->value({4, 0, 4}), 4);
  EXPECT_EQ(box_field({0, 0, 0}, {1, 2, 3})->value({0, 0, 5}), 2);
  EXPECT_EQ(polynomial_field({{2, 1, 2, 3}, {-1, 0, 0, 0}})->value({1, 2, 3}), 215);
  EXPECT_EQ(blinn_field(.5, {{{0, 0, 0}, 2, 1}})->value({0, 0, 0}), -1.5);
  // Wyvill's is half of the height at half of the radius: 4/9 / 64 - 17/9 / 16 + 22/9 / 4 = 1/2.
  EXPECT_NEAR(soft_objects_field(.5, {{{0, 0, 0}, 1, 2}})->value({1, 0, 0}), 0, rounding(5));
  // 1 - 3/9 = 2/3 = 3/2 (2/3)^2 on both sides of R/3.
  EXPECT_NEAR(metaballs_field(1, {{{0, 0, 0}, 1, 3}})->value({1, 0, 0}), 1. / 3, rounding(5));
  EXPECT_NEAR(metaballs_field(1, {{{0, 0, 0}, 1, 3}})->value({2, 0, 0}), 1 - 1.5 / 9, rounding(5));
  EXPECT_EQ(metaballs_field(1, {{{0, 0, 0}, 1, 3}})->value({3, 0, 0}), 1);
  const FieldPointer a = distance_to_point({0, 0, 0}, 1), b = distance_to_point({4, 0, 0}, 1);
  EXPECT_EQ(union_field({a, b})->value({1, 0, 0}), 0);
  EXPECT_EQ(intersection_field({a, b})->value({1, 0, 0}), 2);
  EXPECT_EQ(difference_field({a, b})->value({2, 0, 0}), 1);
  EXPECT_EQ(difference_field({a, b})->value({3.5, 0, 0}), 2.5);
  EXPECT_EQ(smooth_union_field({a, b}, 1)->value({2, 0, 0}), 1 - .25);  // h = 1
  EXPECT_EQ(smooth_union_field({a, b}, 1)->value({0, 0, 0}), -1);       // too far apart
  EXPECT_EQ(offset_field(a, .5)->value({3, 0, 0}), 1.5);
  Eigen::Matrix4d twice = 2 * Eigen::Matrix4d::Identity();
  twice(3, 3) = 1;
  EXPECT_NEAR(transformed_field(a, twice)->value({5, 0, 0}), 3, rounding(5));  // the sphere of radius 2
}

TEST(Field, CurvatureOfSpheresAndTori) {
  for (const double r : {.5, 1., 3.}) {
    const Vector3d x = r * Vector3d(1, 2, 2) / 3;
    for (const FieldPointer& field : {sphere_field({0, 0, 0}, r), distance_to_point({0, 0, 0}, r)}) {
      const auto c = level_curvature(field->jet(x));
      ASSERT_TRUE(c);
      EXPECT_NEAR(c->gauss, 1 / (r * r), rounding(20, 1 / (r * r)));
      EXPECT_NEAR(c->mean, -1 / r, rounding(20, 1 / r));
      EXPECT_LE((c->normal - x / r).norm(), rounding(5));
    }
  }
  // Torus: K = cos t / (r (R + r cos t)), mean -(R + 2 r cos t) / (2 r (R + r cos t)).
  const double R = 1, r = .4;
  const FieldPointer torus = distance_to_circle({0, 0, 0}, {0, 0, 1}, R, r);
  for (const double t : {.1, 1., 2., 3.}) {
    const double c = std::cos(t), w = R + r * c;
    const auto found = level_curvature(torus->jet({w * std::cos(.3), w * std::sin(.3), r * std::sin(t)}));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->gauss, c / (r * w), rounding(100, 10));
    EXPECT_NEAR(found->mean, -(R + 2 * r * c) / (2 * r * w), rounding(100, 10));
  }
}

TEST(Field, SaysWhatDoesNotExist) {
  EXPECT_EQ(distance_to_point({0, 0, 0}, 1)->jet({0, 0, 0}).order, 0);
  EXPECT_FALSE(level_normal(distance_to_point({0, 0, 0}, 1)->jet({0, 0, 0})));
  const FieldJet center = sphere_field({0, 0, 0}, 1)->jet({0, 0, 0});
  EXPECT_EQ(center.order, 2);
  EXPECT_FALSE(level_normal(center));
  EXPECT_FALSE(level_curvature(center));
  const FieldPointer box = box_field({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(box->jet({1, 1, 0}).order, 0);  // an edge
  EXPECT_EQ(box->jet({1, .5, 0}).order, 2);
  EXPECT_EQ(box->pieces({1, 1, 0}, 1e-9).size(), 2u);
  EXPECT_EQ(box->pieces({1, 1, 1}, 1e-9).size(), 3u);
  EXPECT_EQ(box->pieces({0, 0, 0}, 10).size(), 6u);
  EXPECT_TRUE(box->has_edges());
  EXPECT_EQ(metaballs_field(.5, {{{0, 0, 0}, 1, 3}})->jet({1, 0, 0}).order, 1);
  EXPECT_EQ(distance_to_segment({0, 0, 0}, {1, 0, 0}, 1)->jet({1, 1, 0}).order, 1);
}

TEST(Field, ExtentsHoldWhatIsInside) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> anywhere(-3, 3);
  for (const Named& named : fields())
    for (const double level : {-.1, 0., .3}) {
      SCOPED_TRACE(named.name);
      const auto box = named.field->extent(level);
      if (!box) continue;
      for (int i = 0; i < 2000; ++i) {
        const Vector3d x(anywhere(random), anywhere(random), anywhere(random));
        if (named.field->value(x) <= level) {
          EXPECT_TRUE(box->contains(x)) << x.transpose();
        }
      }
    }
  EXPECT_FALSE(distance_to_line({0, 0, 0}, {1, 0, 0}, 1)->extent());
  EXPECT_FALSE(polynomial_field({{1, 0, 0, 0}})->extent());
}

TEST(Field, ProjectionEndsOnTheSurface) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> near(-.2, .2);
  const FieldPointer torus = distance_to_circle({0, 0, 0}, {0, 0, 1}, 1, .4);
  for (int i = 0; i < 50; ++i) {
    const Projection p = project(*torus, Vector3d(1.4, 0, 0) + Vector3d(near(random), near(random), near(random)), 1);
    EXPECT_TRUE(p.converged);
    EXPECT_NEAR(torus->value(p.point), 0, rounding(10, 2));
  }
  EXPECT_FALSE(project(*torus, {9, 0, 0}, 1).converged);
  EXPECT_NEAR((project(*torus, {9, 0, 0}, 1).point - Vector3d(9, 0, 0)).norm(), 1, rounding(10, 9));
}

TEST(Field, RefusesBadNumbers) {
  expect_error<InvalidParameter>([] { sphere_field({0, 0, 0}, 0); }, {"the radius is 0", "more than 0"});
  expect_error<InvalidParameter>([] { sphere_field({nan, 0, 0}, 1); }, {"the center is not finite"});
  expect_error<InvalidParameter>([] { distance_to_line({0, 0, 0}, {0, 0, 0}, 1); }, {"the direction has no length"});
  expect_error<InvalidParameter>([] { distance_to_segment({1, 0, 0}, {1, 0, 0}, 1); }, {"the same point"});
  expect_error<InvalidParameter>([] { distance_to_circle({0, 0, 0}, {0, 0, 1}, -1, 1); }, {"the ring is -1"});
  expect_error<InvalidParameter>([] { distance_to_plane({0, 0, 0}, {0, 0, 1}, -1); }, {"the offset is -1"});
  expect_error<InvalidParameter>([] { distance_to_polygon(square().topRows(2), 1); }, {"2 points", "3 or more"});
  Points bent = square();
  bent(2, 2) = 1;
  expect_error<InvalidParameter>([&] { distance_to_polygon(bent, 1); }, {"off the plane"});
  expect_error<InvalidParameter>([] { box_field({0, 0, 0}, {1, -1, 1}); }, {"half of the box is 1, -1, 1"});
  expect_error<InvalidParameter>([] { polynomial_field({}); }, {"without terms"});
  expect_error<InvalidParameter>([] { polynomial_field({{1, -1, 0, 0}}); }, {"term 0", "negative"});
  expect_error<InvalidParameter>([] { blinn_field(1, {}); }, {"no blobs"});
  expect_error<InvalidParameter>([] { blinn_field(1, {{{0, 0, 0}, 1, 0}}); }, {"blob 0: the decay is 0"});
  expect_error<InvalidParameter>([] { metaballs_field(0, {{{0, 0, 0}, 1, 1}}); }, {"the threshold is 0"});
  expect_error<InvalidParameter>([] { union_field({}); }, {"no fields"});
  expect_error<InvalidParameter>([] { smooth_union_field({sphere_field({0, 0, 0}, 1)}, 0); }, {"the width is 0"});
  expect_error<InvalidParameter>([] { offset_field(nullptr, 1); }, {"missing"});
  Eigen::Matrix4d shear = Eigen::Matrix4d::Identity();
  shear(0, 1) = 1;
  expect_error<InvalidParameter>([&] { transformed_field(sphere_field({0, 0, 0}, 1), shear); }, {"no rotation"});
  expect_error<InvalidParameter>([] { callback_field({}); }, {"without a function"});
}

}  // namespace
}  // namespace sublimit::testing
