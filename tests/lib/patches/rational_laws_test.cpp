// SPDX-License-Identifier: Apache-2.0
// Random rational curves and surfaces, degrees 1 to 9 and knots of all multiplicities, against 256 bits; projective
// maps of them; and the sphere's octant and the torus in fractions.
#include <gtest/gtest.h>

#include <random>

#include "sublimit/patches/detail/spline_rows.h"
#include "sublimit/patches/spline_curve.h"
#include "sublimit/patches/spline_surface.h"
#include "support/tolerance.h"
#include "truth/classical_splines.h"
#include "truth/fraction.h"
#include "truth/precise.h"

namespace sublimit::testing {
namespace {

/// Of derivatives, relative to the sum of the absolute values of their terms.
constexpr double rational_derivative = 1e-12;

Points random_rational_columns(std::mt19937& random, Index rows) {
  std::uniform_real_distribution<double> exponent(-1, 1);
  const Eigen::VectorXd weights =
      Eigen::VectorXd::NullaryExpr(rows, [&](Eigen::Index) { return std::pow(10, exponent(random)); });
  return homogeneous(random_points(random, rows, 3), weights);
}

/// A direction in 256 bits: rows 0 to 2 over the functions of a face.
struct PreciseRows {
  std::vector<Precise> rows;
  Index width, first;

  PreciseRows(const Knots<double>& knots, Index face, double u)
      : rows(3 * (size_t(knots.degree()) + 1)), width(knots.degree() + 1), first(knots.span(face) - knots.degree()) {
    const auto exact =
        Knots<Precise>::open(knots.degree(), knots.num_functions(), {knots.all().begin(), knots.all().end()});
    span_rows(exact, face, Precise(u), 2, std::span<Precise>(rows));
  }
  const Precise& at(int order, Index i) const { return rows[size_t(order * width + i)]; }
};

using PreciseColumn = Eigen::Matrix<Precise, 4, 1>;
using PreciseVector = Eigen::Matrix<Precise, 3, 1>;

/// Sums of columns, and of their absolute values as doubles: of points, and of weights.
struct PreciseSum {
  PreciseColumn value = PreciseColumn::Zero();
  double points = 0, weights = 0;

  void add(const Precise& factor, const Eigen::RowVector4d& column) {
    value += factor * column.transpose().cast<Precise>();
    points += std::abs(static_cast<double>(factor)) * column.head(3).norm();
    weights += std::abs(static_cast<double>(factor) * column[3]);
  }
  PreciseVector A() const { return value.head<3>(); }
  const Precise& w() const { return value[3]; }
};

double distance(const PreciseVector& truth, const Eigen::RowVectorXd& found) {
  const PreciseVector difference = truth - found.transpose().cast<Precise>();
  return difference.cast<double>().norm();
}

double length(const PreciseVector& v) { return v.cast<double>().norm(); }

TEST(RationalCurves, AgreeWith256Bits) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> inside(0, 1);
  for (int degree = 1; degree <= 9; ++degree)
    for (int repeat = 0; repeat < 12; ++repeat) {
      const SplineCurve curve(random_knots<double>(random, degree, repeat % 4 == 3));
      const Knots<double>& knots = curve.knots();
      const Points columns = random_rational_columns(random, curve.num_points());
      for (Index face = 0; face < knots.num_faces(); ++face)
        for (const double u : {0.0, 1e-12, inside(random), 1 - 1e-12, 1.0}) {
          const PreciseRows rows(knots, face, u);
          PreciseSum sums[3];
          for (int r = 0; r < 3; ++r)
            for (Index i = 0; i < rows.width; ++i) sums[r].add(rows.at(r, i), columns.row(knots.point(rows.first + i)));
          const Precise& w = sums[0].w();
          const PreciseVector x = sums[0].A() / w, first = (sums[1].A() - sums[1].w() * x) / w,
                              second = (sums[2].A() - 2 * sums[1].w() * first - sums[2].w() * x) / w;
          const double over = 1 / std::abs(static_cast<double>(w));
          const CurvePlace sample{face, u};
          const CurveSamples at = curve.evaluate(columns, {&sample, 1}, 2, Coordinates::homogeneous);
          EXPECT_LE(distance(x, at.position.row(0)), 4 * eps * over * (sums[0].points + sums[0].weights * length(x)))
              << degree;
          EXPECT_LE(distance(first, at.first.row(0)),
                    rational_derivative * over * (sums[1].points + sums[1].weights * length(x)))
              << degree;
          EXPECT_LE(distance(second, at.second.row(0)),
                    rational_derivative * over *
                        (sums[2].points + 2 * sums[1].weights * length(first) + sums[2].weights * length(x)))
              << degree;
        }
    }
}

TEST(RationalSurfaces, AgreeWith256Bits) {
  std::mt19937 random(32);
  std::uniform_real_distribution<double> inside(0, 1);
  constexpr int orders[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  for (int repeat = 0; repeat < 90; ++repeat) {
    const SplineSurface surface(random_knots<double>(random, 1 + repeat % 9, repeat % 4 == 3),
                                random_knots<double>(random, 1 + int(random() % 9), repeat % 5 == 4));
    const Knots<double>&in_u = surface.u(), &in_v = surface.v();
    const Points columns = random_rational_columns(random, surface.num_points());
    for (int k = 0; k < 12; ++k) {
      const double ends[] = {0, 1e-12, 1 - 1e-12, 1, inside(random), inside(random)};
      const Place sample{static_cast<Index>(random() % unsigned(surface.num_faces())), ends[random() % 6],
                         ends[random() % 6]};
      const PreciseRows u(in_u, sample.face % in_u.num_faces(), sample.u),
          v(in_v, sample.face / in_u.num_faces(), sample.v);
      PreciseSum sums[6];
      for (int r = 0; r < 6; ++r)
        for (Index j = 0; j < v.width; ++j)
          for (Index i = 0; i < u.width; ++i)
            sums[r].add(u.at(orders[r][0], i) * v.at(orders[r][1], j),
                        columns.row(in_u.point(u.first + i) + in_u.num_points() * in_v.point(v.first + j)));
      const Precise& w = sums[0].w();
      PreciseVector x[6];
      double size[6];
      const double over = 1 / std::abs(static_cast<double>(w));
      x[0] = sums[0].A() / w;
      size[0] = over * (sums[0].points + sums[0].weights * length(x[0]));
      for (const int r : {1, 2}) {
        x[r] = (sums[r].A() - sums[r].w() * x[0]) / w;
        size[r] = over * (sums[r].points + sums[r].weights * length(x[0]));
      }
      for (int r = 3; r < 6; ++r) {
        const int a = r == 5 ? 2 : 1, b = r == 3 ? 1 : 2;  // the two first derivatives
        x[r] = (sums[r].A() - sums[a].w() * x[b] - sums[b].w() * x[a] - sums[r].w() * x[0]) / w;
        size[r] = over * (sums[r].points + sums[a].weights * length(x[b]) + sums[b].weights * length(x[a]) +
                          sums[r].weights * length(x[0]));
      }
      const LimitSamples at = surface.evaluate(columns, {&sample, 1}, 2, Coordinates::homogeneous);
      const Points* const found[] = {&at.position, &at.du, &at.dv, &at.duu, &at.duv, &at.dvv};
      EXPECT_LE(distance(x[0], found[0]->row(0)), 4 * eps * size[0]);
      for (int r = 1; r < 6; ++r) EXPECT_LE(distance(x[r], found[r]->row(0)), rational_derivative * size[r]) << r;
    }
  }
}

TEST(RationalSurfaces, MapsOfColumnsAreProjectiveMapsOfTheSurface) {
  std::mt19937 random(33);
  for (int repeat = 0; repeat < 30; ++repeat) {
    const SplineSurface surface(random_knots<double>(random, 1 + repeat % 9, repeat % 4 == 3),
                                random_knots<double>(random, 1 + int(random() % 4), repeat % 5 == 4));
    Points columns = random_rational_columns(random, surface.num_points());
    // Perspective, and near enough to the identity to keep all weights positive: |x| is less than 2.
    const Eigen::Matrix4d map = Eigen::Matrix4d::Identity() + 0.1 * Eigen::Matrix4d(random_points(random, 4, 4));
    const Place sample{static_cast<Index>(random() % unsigned(surface.num_faces())), 0.3, 0.8};
    const LimitSamples at = surface.evaluate(columns, {&sample, 1}, 1, Coordinates::homogeneous),
                       mapped = surface.evaluate(columns * map.transpose(), {&sample, 1}, 1, Coordinates::homogeneous);
    const auto column = [&](const Points& v, double w) { return Eigen::Vector4d(v(0, 0), v(0, 1), v(0, 2), w); };
    const Eigen::Vector4d x = map * column(at.position, 1), u = map * column(at.du, 0);
    EXPECT_LE((mapped.position.row(0).transpose() - x.head(3) / x[3]).norm(), rounding(64, 4));
    const Eigen::Vector3d du = (u.head(3) - u[3] * x.head(3) / x[3]) / x[3];
    EXPECT_LE((mapped.du.row(0).transpose() - du).norm(), other_route * (1 + du.norm()));
  }
}

using FractionColumn = std::array<Fraction, 4>;

/// A profile (X, Z, W) turned by a quarter, weights 1, 1, 2: columns 3 x 3.
std::vector<FractionColumn> turned_by_a_quarter(const std::array<std::array<Fraction, 3>, 3>& profile) {
  constexpr int cosine[] = {1, 1, 0}, sine[] = {0, 1, 2}, omega[] = {1, 1, 2};
  std::vector<FractionColumn> columns;
  for (const auto& [X, Z, W] : profile)
    for (size_t m = 0; m < 3; ++m) columns.push_back({cosine[m] * X, sine[m] * X, omega[m] * Z, omega[m] * W});
  return columns;
}

FractionColumn biquadratic_column(const std::vector<FractionColumn>& columns, const Fraction& u, const Fraction& v) {
  const auto knots = bezier_knots<Fraction>(2);
  std::array<Fraction, 3> in_u, in_v;
  span_rows(knots, 0, u, 0, std::span<Fraction>(in_u));
  span_rows(knots, 0, v, 0, std::span<Fraction>(in_v));
  FractionColumn sum{};
  for (size_t j = 0; j < 3; ++j)
    for (size_t i = 0; i < 3; ++i)
      for (size_t c = 0; c < 4; ++c) sum[c] += in_u[i] * in_v[j] * columns[i + 3 * j][c];
  return sum;
}

TEST(RationalSurfaces, SphereOctantAndTorusAreExactInFractions) {
  // A quarter of the unit circle: (1, 0), (1, 1), (0, 1) with weights 1, 1, 2; for the torus 3 farther from the axis.
  const auto octant = turned_by_a_quarter({{{1, 0, 1}, {1, 1, 1}, {0, 2, 2}}});
  const auto torus = turned_by_a_quarter({{{4, 0, 1}, {4, 1, 1}, {6, 2, 2}}});
  for (int a = 0; a <= 7; ++a)
    for (int b = 0; b <= 5; ++b) {
      const Fraction u(a, 7), v(b, 5);
      const auto [x, y, z, w] = biquadratic_column(octant, u, v);
      EXPECT_EQ(x * x + y * y + z * z, w * w);
      const auto [X, Y, Z, W] = biquadratic_column(torus, u, v);
      const Fraction quartic = X * X + Y * Y + Z * Z + 8 * W * W;
      EXPECT_EQ(quartic * quartic, 36 * (X * X + Y * Y) * W * W);
    }
}

}  // namespace
}  // namespace sublimit::testing
