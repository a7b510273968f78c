// SPDX-License-Identifier: Apache-2.0
// Joins of curves: made with known orders from derivatives at the joint, and the joints of known splines.
#include "sublimit/patches/joins/curve_join.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "support/expect_error.h"
#include "support/tolerance.h"
#include "truth/fraction.h"

namespace sublimit::testing {
namespace {

using Vector = std::vector<Fraction>;
using Piece = BezierPiece<Fraction>;

Fraction draw(std::mt19937& random) { return Fraction(int(random() % 41) - 20) / 7; }
Fraction draw_positive(std::mt19937& random) { return Fraction(1 + int(random() % 30)) / 7; }
Vector draw_vector(std::mt19937& random, int dimension) {
  Vector x;
  for (int k = 0; k < dimension; ++k) x.push_back(draw(random));
  return x;
}
Vector sum(Vector a, const Fraction& factor, const Vector& b) {
  for (size_t k = 0; k < a.size(); ++k) a[k] += factor * b[k];
  return a;
}
Fraction choose(int n, int k) {
  Fraction c = 1;
  for (int i = 0; i < k; ++i) c = c * (n - i) / (i + 1);
  return c;
}

/// The curve of degree x.size() - 1 with derivatives x_0, x_1, .. at its start: b_i = sum of C(i,k)/C(n,k) x_k h^k/k!.
/// Backwards it ends with them.
Piece from_derivatives(const std::vector<Vector>& x, const Fraction& length, bool ends_there = false) {
  Piece piece{.degree = int(x.size()) - 1, .columns = {}, .length = length};
  std::vector<Vector> points;
  for (int i = 0; i <= piece.degree; ++i) {
    Vector point(x[0].size(), Fraction(0));
    Fraction factor = 1;  // (-+ h)^k/k!
    for (int k = 0; k <= i; ++k) {
      if (k > 0) factor *= (ends_there ? Fraction(-length) : length) / k;
      point = sum(point, factor * choose(i, k) / choose(piece.degree, k), x[size_t(k)]);
    }
    points.push_back(point);
  }
  if (ends_there) std::ranges::reverse(points);
  for (const Vector& point : points) piece.columns.insert(piece.columns.end(), point.begin(), point.end());
  return piece;
}

/// q', q'', q''' = as in section 8 of the textbooks' chain rule.
std::vector<Vector> reparametrised(const std::vector<Vector>& p, const Fraction& b1, const Fraction& b2,
                                   const Fraction& b3) {
  std::vector<Vector> q{p[0]};
  const Vector zero(p[0].size(), Fraction(0));
  const auto of = [&](size_t k) { return k < p.size() ? p[k] : zero; };
  q.push_back(sum(zero, b1, of(1)));
  q.push_back(sum(sum(zero, b1 * b1, of(2)), b2, of(1)));
  q.push_back(sum(sum(sum(zero, b1 * b1 * b1, of(3)), 3 * b1 * b2, of(2)), b3, of(1)));
  return q;
}

std::vector<Vector> random_derivatives(std::mt19937& random, int degree, int dimension) {
  std::vector<Vector> x;
  for (int k = 0; k <= degree; ++k) x.push_back(draw_vector(random, dimension));
  x[size_t(degree)][0] += 100;  // the degree is not less
  return x;
}

/// Homogeneous, by a projective map that keeps w > 0 near the joint, times a constant.
Piece projected(const Piece& piece, int dimension, const Fraction& factor) {
  Piece result = piece;
  result.coordinates = Coordinates::homogeneous;
  result.columns.clear();
  for (size_t at = 0; at < piece.columns.size(); at += size_t(dimension)) {
    Fraction w = 4000;
    for (int k = 0; k < dimension; ++k) {
      w += piece.columns[at + size_t(k)] * (k + 1) / 3;
      result.columns.push_back(factor * (piece.columns[at + size_t(k)] * (k + 2) + 1));
    }
    result.columns.push_back(factor * w);
  }
  return result;
}

TEST(CurveJoin, DerivativesThatAgreeAreCAndGWhereTheSpeedIsNotZero) {
  std::mt19937 random(3);
  for (int degree = 1; degree <= 9; ++degree)
    for (int c = 0; c <= degree; ++c) {
      const int dimension = 2 + int(random() % 2);
      std::vector<Vector> x = random_derivatives(random, degree, dimension);
      const Piece left = from_derivatives(x, draw_positive(random), true);
      // Beyond c derivatives turn away, by what no change of parameters makes good: perpendicular to x'.
      if (c < degree) {
        const Vector d{-x[1][1], x[1][0]};
        x[size_t(c) + 1][0] += d[0], x[size_t(c) + 1][1] += d[1];
      }
      const Piece right = from_derivatives(x, draw_positive(random));
      const CurveJoin join = curve_join(left, right);
      EXPECT_EQ(join.orders.c, c) << degree;
      EXPECT_EQ(join.orders.is_same, c == degree);
      EXPECT_EQ(join.orders.g, c == degree ? std::max(3, degree) : c) << degree;
      EXPECT_EQ(join.orders.obstacle, c == degree ? JoinObstacle::none
                                      : c == 0    ? JoinObstacle::angle
                                                  : JoinObstacle::curvature);
      EXPECT_EQ(join.gap, 0);
      for (size_t k = 0; k < join.ratios.size(); ++k) EXPECT_EQ(join.ratios[k], k == 0 ? 1 : 0);
      // Projective maps and common factors keep the orders.
      const CurveJoin rational = curve_join(projected(left, dimension, 1), projected(right, dimension, 7));
      if (c < degree) {
        EXPECT_EQ(rational.orders.c, c);
        EXPECT_EQ(rational.orders.g, c);
      }
      EXPECT_EQ(rational.orders.is_same, c == degree);
    }
}

TEST(JoinOrders, AreSaidWithoutCapsThatReadLikeVerdicts) {
  EXPECT_EQ(words_of({5, 5, true, JoinObstacle::none}), "C^infinity, G^infinity");
  EXPECT_EQ(words_of({5, 1, true, JoinObstacle::no_speed}), "C^infinity, G^1 (no-speed)");
  EXPECT_EQ(words_of({0, 3, false, JoinObstacle::none}), "C^0, G^3 at least");
  EXPECT_EQ(words_of({2, 2, false, JoinObstacle::curvature}), "C^2, G^2 (curvature)");
  EXPECT_EQ(words_of({-1, -1, false, JoinObstacle::gap}), "a gap");
  EXPECT_EQ(words_of({-1, -1, false, JoinObstacle::pole}), "a pole");
}

TEST(CurveJoin, ChangesOfParametersAreFound) {
  std::mt19937 random(4);
  for (int repeat = 0; repeat < 60; ++repeat) {
    const int degree = 2 + repeat % 8, dimension = 2 + repeat % 2, g = 1 + int(random() % 3);
    const std::vector<Vector> p = random_derivatives(random, degree, dimension);
    const Fraction b1 = draw_positive(random), b2 = draw(random) + 10, b3 = draw(random);
    std::vector<Vector> q = reparametrised(p, b1, b2, b3);
    const Vector d{-p[1][1], p[1][0]};
    if (g < 3) q[size_t(g) + 1][0] += d[0], q[size_t(g) + 1][1] += d[1];
    const Piece left = from_derivatives(p, draw_positive(random), true), right = from_derivatives(q, 1);
    const CurveJoin join = curve_join(left, right);
    EXPECT_EQ(join.orders.c, b1 == 1 ? 1 : 0);
    EXPECT_GE(join.orders.g, g);
    if (g < 3) {
      EXPECT_EQ(join.orders.g, g);
    }
    const double expected[] = {double(b1), double(b2), double(b3)};
    for (int k = 0; k < g; ++k) EXPECT_NEAR(join.ratios[size_t(k)], expected[k], rounding(4, 30));
    EXPECT_LE(*join.angle, rounding(4));
    if (g >= 2) {
      EXPECT_LE(*join.curvature_jump, rounding(64, curve_join_detail::length(join.left_curvature)));
    }
    // In doubles, measured.
    const auto rounded = [](const Piece& piece) {
      BezierPiece<double> result{.degree = piece.degree, .columns = {}, .length = double(piece.length)};
      for (const Fraction& x : piece.columns) result.columns.push_back(double(x));
      return result;
    };
    const CurveJoin measured = curve_join(rounded(left), rounded(right));
    EXPECT_EQ(measured.orders.c, join.orders.c) << degree;
    EXPECT_EQ(std::min(measured.orders.g, 3), std::min(join.orders.g, 3)) << degree;
    // Rational ones.
    EXPECT_EQ(std::min(3, curve_join(projected(left, dimension, 2), projected(right, dimension, 3)).orders.g),
              std::min(3, join.orders.g));
    // Backwards it is as smooth, folded over it is not.
    std::vector<Vector> folded = q;
    for (Fraction& x : folded[1]) x = -x;
    const CurveJoin cusp = curve_join(left, from_derivatives(folded, 1));
    EXPECT_EQ(cusp.orders.g, 0);
    EXPECT_EQ(cusp.orders.obstacle, JoinObstacle::folded_back);
    EXPECT_NEAR(*cusp.angle, std::numbers::pi, rounding(4));
  }
}

TEST(CurveJoin, IntervalsCountForCAndNotForG) {
  // The joint divides its neighbours 2 : 3.
  const Piece left{.degree = 1, .columns = {0, 0, 2, 0}, .length = 2},
      right{.degree = 1, .columns = {2, 0, 5, 0}, .length = 3};
  EXPECT_EQ(curve_join(left, right).orders, (JoinOrders{1, 3, true, JoinObstacle::none}));
  Piece other = right;
  other.length = 1;
  const CurveJoin join = curve_join(left, other);
  EXPECT_EQ(join.orders, (JoinOrders{0, 3, false, JoinObstacle::none}));
  EXPECT_EQ(join.ratios, (std::vector<double>{3, 0, 0}));
}

TEST(CurveJoin, GapsAndAnglesAreWhatTheyAre) {
  const BezierPiece<double> left{.degree = 1, .columns = {0, 0, 0, 1, 0, 0}};
  const BezierPiece<double> away{.degree = 1, .columns = {1, 0.25, 0, 2, 0, 0}};
  const CurveJoin gap = curve_join(left, away);
  EXPECT_EQ(gap.orders, JoinOrders{});
  EXPECT_EQ(gap.gap, 0.25);
  EXPECT_EQ(gap.point, (std::vector<double>{1, 0, 0}));
  for (const double angle : {1e-7, 1e-3, 0.7, 3.0}) {
    const BezierPiece<double> turned{
        .degree = 1, .columns = {1, 0, 0, 1 + std::cos(angle), std::sin(angle) * 0.6, std::sin(angle) * 0.8}};
    const CurveJoin join = curve_join(left, turned);
    EXPECT_NEAR(*join.angle, angle, rounding(8));
    EXPECT_EQ(join.orders.g, 0);
    EXPECT_EQ(join.orders.obstacle, JoinObstacle::angle);
  }
  // A parabola of curvature 2 after a line.
  const CurveJoin bent = curve_join(left, {.degree = 2, .columns = {1, 0, 0, 1.5, 0, 0, 2, 1, 0}});
  EXPECT_EQ(bent.orders.c, 1);
  EXPECT_EQ(bent.orders.g, 1);
  EXPECT_EQ(*bent.curvature_jump, 2);
}

/// The joint of two segments of a spline.
template <class T>
CurveJoin joint(const Knots<T>& knots, const std::vector<T>& columns, int width, Coordinates coordinates, Index face) {
  const auto piece = [&](Index f) {
    BezierPiece<T> result{
        .degree = knots.degree(), .columns = {}, .coordinates = coordinates, .length = knots.length(f)};
    const BandRows<T> rows = bezier_rows(knots, f);
    for (Index r = 0; r < rows.size(); ++r)
      for (int k = 0; k < width; ++k) {
        T sum(0);
        for (Index i = 0; i < rows.width; ++i)
          sum += rows[r][i] * columns[size_t(knots.point(rows.first[r] + i) * width + k)];
        result.columns.push_back(sum);
      }
    return result;
  };
  return curve_join(piece(face), piece(face + 1));
}

TEST(CurveJoin, ATripleControlPointIsC2WithACorner) {
  std::vector<Fraction> knots;
  for (int i = 0; i < 11; ++i) knots.push_back(i);
  const auto uniform = Knots<Fraction>::open(3, 7, knots);
  const CurveJoin corner = joint(uniform, {0, 0, 1, 0, 2, 0, 2, 0, 2, 0, 3, 1, 4, 4}, 2, Coordinates::plain, 1);
  EXPECT_EQ(corner.orders.c, 2);
  EXPECT_EQ(corner.orders.g, 0);
  EXPECT_EQ(corner.orders.obstacle, JoinObstacle::angle);
  EXPECT_NEAR(*corner.angle, std::numbers::pi / 4, rounding(4));  // from (1, 0) to (1, 1)
  EXPECT_FALSE(corner.curvature_jump);
  // With the points on one line it is straight, and there is no more to be said of it.
  const CurveJoin straight =
      joint(uniform, {0, 0, 1, 0, 2, 0, 2, 0, 2, 0, Fraction(7) / 2, 0, 4, 0}, 2, Coordinates::plain, 1);
  EXPECT_EQ(straight.orders.c, 2);
  EXPECT_EQ(straight.orders.g, 1);
  EXPECT_EQ(straight.orders.obstacle, JoinObstacle::no_speed);
}

TEST(CurveJoin, ACuspIsOnePolynomialAndNotG1) {
  // (t^2, t^3) arrives and leaves in the direction (1, 0), backwards and forwards.
  const Piece left = from_derivatives({{0, 0}, {0, 0}, {2, 0}, {0, 6}}, 1, true),
              right = from_derivatives({{0, 0}, {0, 0}, {2, 0}, {0, 6}}, 1);
  const CurveJoin cusp = curve_join(left, right);
  EXPECT_EQ(cusp.orders, (JoinOrders{3, 0, true, JoinObstacle::folded_back}));
  // (t^3, t^3) goes on.
  const CurveJoin slow = curve_join(from_derivatives({{0, 0}, {0, 0}, {0, 0}, {6, 6}}, 1, true),
                                    from_derivatives({{0, 0}, {0, 0}, {0, 0}, {6, 6}}, 1));
  EXPECT_EQ(slow.orders, (JoinOrders{3, 1, true, JoinObstacle::no_speed}));
  // A piece that is one point has no tangent.
  const CurveJoin point = curve_join(left, Piece{.degree = 1, .columns = {0, 0, 0, 0}});
  EXPECT_EQ(point.orders, (JoinOrders{1, 0, false, JoinObstacle::no_tangent}));
  EXPECT_FALSE(point.angle);
}

TEST(CurveJoin, TheCircleOfNinePointsIsC1AndSmoothWhereItsColumnsAreC0) {
  const double h = std::sqrt(0.5);
  const auto knots = Knots<double>::open(2, 9, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4});
  const std::vector<double> columns{1, 0,  1,  h, h, h,  0, 1, 1,  -h, h, h, -1, 0,
                                    1, -h, -h, h, 0, -1, 1, h, -h, h,  1, 0, 1};
  for (Index face = 0; face < 3; ++face) {
    EXPECT_EQ(*knots.continuity(face, KnotSide::right), 0);
    const CurveJoin join = joint(knots, columns, 3, Coordinates::homogeneous, face);
    EXPECT_EQ(join.orders.c, 1);
    EXPECT_EQ(join.orders.g, 4);  // the highest that is looked for
    EXPECT_EQ(join.orders.obstacle, JoinObstacle::none);
    EXPECT_NEAR(curve_join_detail::length(join.left_curvature), 1, rounding(8));
    EXPECT_LE(*join.curvature_jump, rounding(8));
    // The second derivative jumps along the tangent, by 2 (2 sqrt 2 - 2): with speed sqrt 2 twice 0.828.., b_2 is
    // its quotient.
    EXPECT_NEAR(std::abs(join.ratios[1]) * h * 2, 4 * (std::sqrt(2.0) - 1), rounding(64));
  }
  // As plain points with the same numbers it is no smoother than its columns.
  EXPECT_EQ(joint(knots, columns, 3, Coordinates::plain, 0).orders.c, 0);
}

TEST(CurveJoin, RandomSplinesAreAsSmoothAsTheirKnotsSay) {
  std::mt19937 random(5);
  for (int degree = 1; degree <= 9; ++degree)
    for (int times = 1; times <= degree + 1; ++times) {
      std::vector<Fraction> all(size_t(degree) + 1, Fraction(0));
      all.insert(all.end(), size_t(times), draw_positive(random));
      all.insert(all.end(), size_t(degree) + 1, all.back() + draw_positive(random));
      const Index points = Index(all.size()) - degree - 1;
      const auto knots = Knots<Fraction>::open(degree, points, all);
      Vector columns;
      for (Index i = 0; i < 3 * points; ++i) columns.push_back(draw(random) + i);
      const CurveJoin join = joint(knots, columns, 3, Coordinates::plain, 0);
      EXPECT_EQ(join.orders.c, degree - times);
      EXPECT_EQ(join.orders.g, join.orders.c);
    }
}

TEST(CurveJoin, PolesAreNoJoins) {
  const BezierPiece<double> good{.degree = 1, .columns = {0, 0, 1, 1, 0, 1}, .coordinates = Coordinates::homogeneous};
  const BezierPiece<double> pole{.degree = 1, .columns = {1, 0, 0, 1, 0, 0}, .coordinates = Coordinates::homogeneous};
  EXPECT_EQ(curve_join(good, pole).orders.obstacle, JoinObstacle::pole);
  EXPECT_EQ(curve_join(pole, good).orders.obstacle, JoinObstacle::pole);
  EXPECT_EQ(curve_join(pole, good).orders.c, -1);
}

TEST(CurveJoin, RefusesBrokenInput) {
  const BezierPiece<double> good{.degree = 1, .columns = {0, 0, 1, 1}};
  const auto with = [&](auto change) {
    BezierPiece<double> bad = good;
    change(bad);
    return bad;
  };
  const auto refused = [&](const BezierPiece<double>& bad, std::initializer_list<std::string_view> parts) {
    expect_error<InvalidParameter>([&] { curve_join(good, bad); }, parts);
  };
  refused(with([](auto& p) { p.length = 0; }), {"right curve", "length 0", "must be positive"});
  refused(with([](auto& p) { p.length = -2; }), {"right curve", "length -2"});
  refused(with([](auto& p) { p.length = std::numeric_limits<double>::infinity(); }), {"right curve", "length inf"});
  refused(with([](auto& p) { p.columns.pop_back(); }), {"right curve", "3 numbers for 2 control points"});
  refused(with([](auto& p) { p.columns.clear(); }), {"right curve", "0 numbers"});
  refused(with([](auto& p) { p.columns[2] = std::nan(""); }), {"right curve", "control point 1", "nan", "finite"});
  refused(with([](auto& p) { p.columns = {1, 2, 3, 4, 5, 6}; }), {"2 and 3 coordinates", "one space"});
  refused(with([](auto& p) { p.degree = -1; }), {"degree", "-1"});
  expect_error<InvalidParameter>([&] { curve_join(with([](auto& p) { p.length = 0; }), good); }, {"left curve"});
}

}  // namespace
}  // namespace sublimit::testing
