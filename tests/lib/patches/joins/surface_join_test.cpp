// SPDX-License-Identifier: Apache-2.0
// Joins of patches in exact fractions: a surface F and F(phi), moved off itself by powers of u; tangent strips; numbers
// that are known.
#include "sublimit/patches/joins/surface_join.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "lib/patches/joins/power_patch.h"
#include "support/expect_error.h"
#include "support/tolerance.h"
#include "truth/fraction.h"

namespace sublimit::testing {
namespace {

using F = Fraction;
using Poly = PowerPolynomial<F>;
using Surface = PowerSurface<F>;
using Patch = BezierPatch<F>;

const Poly u = Poly::linear(0, 1, 0), v = Poly::linear(0, 0, 1), u_before = Poly::linear(-1, 1, 0);

Surface composed(const Surface& surface, const Poly& in_u, const Poly& in_v) {
  Surface result;
  for (const Poly& f : surface) result.push_back(composed(f, in_u, in_v));
  return result;
}
/// z + f.
Surface lifted(Surface surface, const Poly& f) {
  surface[2] = surface[2] + f;
  return surface;
}
Poly scaled(const F& factor, const Poly& f) { return Poly::constant(factor) * f; }

/// Homogeneous columns by a projective map, w > 0 for points that are not large, times a constant.
Surface projected(const Surface& s, const F& factor = 1) {
  const Poly one = Poly::constant(1);
  const Poly w = scaled(40, one) + s[0] + scaled(2, s[1]) + scaled(-1, s[2]);
  Surface result{scaled(3, s[0]) + s[1] + one, scaled(2, s[1]) + scaled(-1, s[2]), scaled(5, s[2]) + s[0], w};
  for (Poly& f : result) f = scaled(factor, f);
  return result;
}

struct Case {
  const char* what;
  Surface right;
  int c, g;
  JoinObstacle obstacle;
};

std::vector<Case> cases(const Surface& s) {
  const F half = F(1) / 2;
  return {
      {"itself", composed(s, u, v), 99, 2, JoinObstacle::none},
      {"scaled", composed(s, scaled(half, u), v), 0, 2, JoinObstacle::none},
      {"sheared", composed(s, u, v + scaled(half, u)), 0, 2, JoinObstacle::none},
      {"u + u^2", composed(s, u + scaled(half, u * u), v), 1, 2, JoinObstacle::none},
      {"sheared along the edge", composed(s, u + scaled(half, u * v), v + scaled(F(1) / 3, u * v)), 0, 2,
       JoinObstacle::none},
      {"+ u^2 n", lifted(s, u * u), 1, 1, JoinObstacle::curvature},
      {"scaled + u^2 n", lifted(composed(s, scaled(half, u), v), u * u * v), 0, 1, JoinObstacle::curvature},
      {"+ u^3 n", lifted(s, u * u * u), 2, 2, JoinObstacle::none},
      {"+ u n", lifted(s, u), 0, 0, JoinObstacle::angle},
      {"+ u v n", lifted(s, u * v), 0, 0, JoinObstacle::angle},
      {"+ v n", lifted(s, v), -1, -1, JoinObstacle::gap},
      {"folded back", composed(s, scaled(-1, u), v), 0, 0, JoinObstacle::folded_back},
  };
}

TEST(SurfaceJoin, SurfacesAndTheirReparametrisationsHaveTheOrdersOfTheirMaps) {
  std::mt19937 random(6);
  for (int degree_u = 1; degree_u <= 3; ++degree_u)
    for (int degree_v = 1; degree_v <= 3; ++degree_v) {
      const Surface s = random_power_surface<F>(random, degree_u, degree_v);
      const Surface before = composed(s, u_before, v);
      for (const Case& c : cases(s)) {
        for (const bool rational : {false, true}) {
          const Patch left = bezier_patch(rational ? projected(before) : before),
                      right = bezier_patch(rational ? projected(c.right, F(3) / 7) : c.right);
          const SurfaceJoin join = surface_join(left, right);
          ASSERT_TRUE(join.exact);
          // Orders above 2 follow from C^k.
          EXPECT_EQ(join.exact->g, c.g == 2 ? std::max(2, join.exact->c) : c.g)
              << c.what << (rational ? ", rational " : " ") << degree_u << degree_v;
          EXPECT_EQ(join.exact->obstacle, c.obstacle) << c.what << name(join.exact->obstacle);
          if (c.c == 99) {
            EXPECT_TRUE(join.exact->is_same) << c.what;
          } else {
            EXPECT_EQ(join.exact->c, c.c) << c.what << (rational ? ", rational" : "");
          }
          EXPECT_EQ(join.measured.g, join.exact->g) << c.what << " " << join.deviation.gap.value;
          EXPECT_EQ(join.measured.c, join.exact->c) << c.what;
          EXPECT_EQ(join.measured.is_same, join.exact->is_same) << c.what;
          EXPECT_EQ(join.measured.obstacle, join.exact->obstacle) << c.what << name(join.measured.obstacle);
        }
      }
    }
}

TEST(SurfaceJoin, HighDegreesAreDecidedToo) {
  std::mt19937 random(7);
  for (const auto& [degree_u, degree_v] : {std::pair{9, 2}, {2, 9}, {5, 6}}) {
    const Surface s = random_power_surface<F>(random, degree_u, degree_v);
    const Patch left = bezier_patch(composed(s, u_before, v));
    const JoinOrders scaled_one = exact_orders(left, bezier_patch(composed(s, scaled(F(1) / 4, u), v)));
    EXPECT_EQ(scaled_one, (JoinOrders{0, 2, false, JoinObstacle::none}));
    const JoinOrders bent = exact_orders(left, bezier_patch(lifted(s, scaled(F(1) / 1000000000, u * u))));
    EXPECT_EQ(bent, (JoinOrders{1, 1, false, JoinObstacle::curvature}));
  }
}

TEST(SurfaceJoin, LengthsOfIntervalsCountForC) {
  std::mt19937 random(8);
  const Surface s = random_power_surface<F>(random, 2, 2);
  const Patch left = bezier_patch(composed(s, u_before, v), F(2));
  EXPECT_EQ(exact_orders(left, bezier_patch(composed(s, u, v), F(2))).is_same, true);
  EXPECT_EQ(exact_orders(left, bezier_patch(composed(s, u, v), F(1))).c, 0);
  EXPECT_EQ(exact_orders(left, bezier_patch(composed(s, scaled(F(1) / 2, u), v), F(1))).is_same, true);
}

TEST(SurfaceJoin, DegreesAlongTheEdgeMayDiffer) {
  // The same surface written with higher degrees.
  std::mt19937 random(9);
  const Surface s = random_power_surface<F>(random, 2, 2);
  Surface high = composed(s, u, v);
  high[0] = high[0] + Poly::zero(4, 3);
  EXPECT_EQ(bezier_patch(high).degree_v, 3);
  const SurfaceJoin join = surface_join(bezier_patch(composed(s, u_before, v)), bezier_patch(high));
  EXPECT_TRUE(join.exact->is_same);
  EXPECT_GE(join.exact->c, 2);
  EXPECT_EQ(join.exact->g, join.exact->c);  // one surface: as smooth as was looked at, in both senses
  EXPECT_TRUE(join.measured.is_same);
  // A factor that is a polynomial along the edge changes nothing: (1 + v/2 + u) H.
  Surface multiplied = projected(s);
  for (Poly& f : multiplied) f = f * (Poly::linear(1, 1, F(1) / 2));
  const JoinOrders rational = exact_orders(bezier_patch(projected(composed(s, u_before, v))), bezier_patch(multiplied));
  EXPECT_TRUE(rational.is_same);
  EXPECT_GE(rational.c, 2);
  EXPECT_EQ(rational.g, rational.c);
  // Plain on one side, homogeneous on the other.
  Surface weighted = composed(s, scaled(F(1) / 2, u), v);
  weighted.push_back(Poly::constant(1));
  for (Poly& f : weighted) f = f * Poly::linear(1, 1, 1);
  EXPECT_EQ(exact_orders(bezier_patch(composed(s, u_before, v)), bezier_patch(weighted)),
            (JoinOrders{0, 2, false, JoinObstacle::none}));
}

/// Control point i, j.
std::array<F, 3> point(const Patch& patch, int i, int j) {
  const size_t at = 3 * size_t(j * (patch.degree_u + 1) + i);
  return {patch.columns[at], patch.columns[at + 1], patch.columns[at + 2]};
}

TEST(SurfaceJoin, EqualRulingsOfTheTangentStripsAreG1) {
  std::mt19937 random(10);
  const auto draw = [&] { return F(int(random() % 41) - 20) / 200; };
  for (int degree = 1; degree <= 9; ++degree) {
    const Patch left = bezier_patch(composed(random_power_surface<F>(random, degree, 1 + degree % 5), u_before, v));
    for (const F& lambda : {F(1), F(2) / 3, F(-1) / 2}) {
      // c_j - b_j = lambda (b_j - a_j), the rest is free: two more columns.
      Patch right{.degree_u = 3, .degree_v = left.degree_v};
      for (int j = 0; j <= left.degree_v; ++j) {
        const std::array<F, 3> a = point(left, left.degree_u - 1, j), b = point(left, left.degree_u, j);
        for (int i = 0; i <= 3; ++i)
          for (size_t k = 0; k < 3; ++k)
            right.columns.push_back(b[k] + (i == 0 ? F(0) : F(lambda * (b[k] - a[k]))) + (i > 1 ? draw() : F(0)));
      }
      const SurfaceJoin join = surface_join(left, right);
      if (lambda < 0) {
        EXPECT_EQ(join.exact->g, 0);
        EXPECT_EQ(join.exact->obstacle, JoinObstacle::folded_back);
        EXPECT_EQ(join.measured.obstacle, JoinObstacle::folded_back);
        continue;
      }
      EXPECT_EQ(join.exact->g, 1) << degree;
      EXPECT_EQ(join.exact->obstacle, JoinObstacle::curvature);
      // C^1 if 3 lambda is the degree of the left one.
      EXPECT_EQ(join.exact->c, 3 * lambda == left.degree_u ? 1 : 0) << degree;
      EXPECT_LE(join.deviation.angle->value, rounding(64));
      EXPECT_EQ(join.measured.g, 1);
      // One of its points moved by 1e-12: no longer, and no rounded number tells.
      right.columns[4] += F(1) / F(1000000000000LL);
      EXPECT_EQ(exact_orders(left, right).g, 0);
      EXPECT_EQ(surface_join(left, right).measured.g, 1);
    }
  }
}

/// u in [-1, 0] of the plane z = 0, or beyond u = 0 of z = f(u, v).
Patch graph(const Poly& f, bool before) {
  const Poly& x = before ? u_before : u;
  return bezier_patch<F>({x, v, composed(f, x, v)});
}

TEST(SurfaceJoin, NumbersAreThoseOfGraphs) {
  const Patch plane = graph(Poly::constant(0), true);
  // An angle everywhere, and one that is greatest inside.
  const SurfaceJoin bent = surface_join(plane, graph(scaled(F(1) / 1000, u), false));
  EXPECT_NEAR(bent.deviation.angle->value, std::atan(1e-3), rounding(4));
  EXPECT_EQ(bent.exact->obstacle, JoinObstacle::angle);
  EXPECT_EQ(bent.measured.obstacle, JoinObstacle::angle);
  const Poly bump = v * Poly::linear(1, 0, -1) * v;  // v^2 (1 - v), 4/27 at 2/3
  const SurfaceJoin inside = surface_join(plane, graph(u * bump, false));
  EXPECT_NEAR(inside.deviation.angle->value, std::atan(4.0 / 27), rounding(16));
  constexpr double at_maximum = 1e-7;  // it is flat: half of the digits
  EXPECT_NEAR(inside.deviation.angle->s, 2.0 / 3, at_maximum);
  EXPECT_NEAR(inside.deviation.angle->point[1], 2.0 / 3, at_maximum);
  EXPECT_LE(inside.deviation.gap.value, rounding(1));
  // z = u^2 f has the curvature 2 f across the edge.
  const SurfaceJoin curved = surface_join(plane, graph(u * u * bump, false));
  EXPECT_NEAR(curved.deviation.curvature_jump->value, 8.0 / 27, rounding(64));
  constexpr double at_maximum_of_jump = 1e-6;  // and of second derivatives
  constexpr double at_samples = 1e-3;          // the greatest curvature is that of samples
  EXPECT_NEAR(curved.deviation.curvature_jump->s, 2.0 / 3, at_maximum_of_jump);
  EXPECT_NEAR(curved.deviation.greatest_curvature, 8.0 / 27, at_samples);
  EXPECT_EQ(curved.exact->g, 1);
  // A gap.
  const SurfaceJoin open = surface_join(plane, graph(bump, false));
  EXPECT_NEAR(open.deviation.gap.value, 4.0 / 27, rounding(16));
  EXPECT_EQ(open.measured, JoinOrders{});
  EXPECT_EQ(*open.exact, JoinOrders{});
}

TEST(SurfaceJoin, SayWhereThereAreNoNormals) {
  // All of the left patch's edge has the derivative 0 across it.
  const Poly square = u_before * u_before;
  const Patch flat = bezier_patch<F>({square, v, Poly::constant(0)});
  const SurfaceJoin none = surface_join(flat, graph(Poly::constant(0), false));
  EXPECT_EQ(none.exact->g, 0);
  EXPECT_EQ(none.exact->obstacle, JoinObstacle::no_tangent);
  EXPECT_EQ(none.measured.obstacle, JoinObstacle::no_tangent);
  // Two sectors of a disk meet at its centre, where normals vanish at the end of the edge: (u v, v).
  const Patch left = bezier_patch<F>({u_before * v, v, Poly::constant(0)}),
              right = bezier_patch<F>({u * v, v, Poly::constant(0)});
  const SurfaceJoin sectors = surface_join(left, right);
  EXPECT_EQ(*sectors.exact, (JoinOrders{1, 2, true, JoinObstacle::none}));
  EXPECT_EQ(sectors.measured, *sectors.exact);
  // It folds where v = 1/3.
  const Poly side = Poly::linear(F(-1) / 3, 0, 1);
  const Patch folds = bezier_patch<F>({u * side, v, Poly::constant(0)});
  EXPECT_EQ(exact_orders(graph(Poly::constant(0), true), folds).obstacle, JoinObstacle::folded_back);
  const Patch touches = bezier_patch<F>({u * side * side, v, Poly::constant(0)});
  EXPECT_EQ(exact_orders(graph(Poly::constant(0), true), touches).obstacle, JoinObstacle::undecided);
  // A denominator that vanishes on the edge.
  Surface pole{u * side, v, Poly::constant(0), side};
  EXPECT_EQ(exact_orders(graph(Poly::constant(0), true), bezier_patch(pole)).obstacle, JoinObstacle::pole);
}

TEST(SurfaceJoin, RefusesBrokenInput) {
  const BezierPatch<double> good{.degree_u = 1, .degree_v = 1, .columns = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}};
  const auto refused = [&](auto change, std::initializer_list<std::string_view> parts) {
    BezierPatch<double> bad = good;
    change(bad);
    expect_error<InvalidParameter>([&] { surface_join(good, bad); }, parts);
  };
  refused([](auto& p) { p.length = 0; }, {"right patch", "length 0", "must be positive"});
  refused([](auto& p) { p.length = -1; }, {"right patch", "length -1"});
  refused([](auto& p) { p.columns.pop_back(); }, {"right patch", "11 numbers for 4 control points; 12 are needed"});
  refused([](auto& p) { p.degree_v = 2; }, {"right patch", "12 numbers for 6 control points; 18 are needed"});
  refused([](auto& p) { p.coordinates = Coordinates::homogeneous; }, {"16 are needed"});
  refused([](auto& p) { p.columns[4] = std::numeric_limits<double>::infinity(); }, {"control point 1", "inf"});
  refused([](auto& p) { p.degree_u = -1; }, {"degree", "-1"});
  BezierPatch<double> bad = good;
  bad.length = std::nan("");
  expect_error<InvalidParameter>([&] { surface_join(bad, good); }, {"left patch", "length nan"});
}

}  // namespace
}  // namespace sublimit::testing
