// SPDX-License-Identifier: Apache-2.0
// What bases reproduce, what their Bezier points are, and the open grid under Catmull-Clark that is a B-spline.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sublimit/patches/constructions/lagrange_basis.h"
#include "sublimit/patches/constructions/polynomial_curves.h"
#include "sublimit/patches/detail/finer_knots.h"
#include "sublimit/patches/detail/segment_basis.h"
#include "sublimit/patches/detail/spline_rows.h"
#include "sublimit/patches/spline_surface.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"
#include "truth/classical_splines.h"
#include "truth/fraction.h"

namespace sublimit::testing {
namespace {

/// Elementary symmetric polynomials e_0 .. e_n of some values.
std::vector<Fraction> elementary_symmetric(std::span<const Fraction> values) {
  std::vector<Fraction> e(values.size() + 1, Fraction(0));
  e[0] = 1;
  for (size_t i = 0; i < values.size(); ++i)
    for (size_t k = i + 1; k > 0; --k) e[k] += values[i] * e[k - 1];
  return e;
}

// Marsden: t^k = sum_i N_i(t) e_k(t_{i+1}, .., t_{i+p}) / C(p, k), the blossom of t^k at the knots.
TEST(KnownBases, BsplinesReproducePowersUpToTheirDegree) {
  std::mt19937 random(41);
  for (int degree = 1; degree <= 9; ++degree)
    for (int repeat = 0; repeat < 6; ++repeat) {
      const Knots<Fraction> knots =
          repeat == 0 ? bezier_knots<Fraction>(degree) : random_knots<Fraction>(random, degree, repeat % 3 == 2);
      const size_t width = size_t(degree) + 1;
      for (Index face = 0; face < knots.num_faces(); ++face)
        for (const Fraction& u : {Fraction(0), Fraction(3, 11), Fraction(1)}) {
          std::vector<Fraction> rows(3 * width);
          span_rows(knots, face, u, 2, std::span<Fraction>(rows));
          const Fraction t = knots.parameter({face, u}), h = knots.length(face);
          std::vector<Fraction> powers(width, Fraction(1));
          for (size_t k = 1; k < width; ++k) powers[k] = t * powers[k - 1];
          std::vector<std::vector<Fraction>> blossoms;
          for (size_t i = 0; i < width; ++i)
            blossoms.push_back(
                elementary_symmetric(knots.all().subspan(size_t(knots.span(face) - degree) + i + 1, size_t(degree))));
          Fraction binomial(1);  // C(p, k)
          for (size_t k = 0; k < width; ++k) {
            Fraction moments[3] = {0, 0, 0};
            for (size_t r = 0; r < 3; ++r)
              for (size_t i = 0; i < width; ++i) moments[r] += rows[r * width + i] * blossoms[i][k] / binomial;
            EXPECT_EQ(moments[0], powers[k]);
            EXPECT_EQ(moments[1], k < 1 ? Fraction(0) : Fraction(int(k) * h * powers[k - 1]));
            EXPECT_EQ(moments[2], k < 2 ? Fraction(0) : Fraction(int(k * (k - 1)) * h * h * powers[k - 2]));
            binomial = binomial * (degree - int(k)) / (int(k) + 1);
          }
        }
    }
}

TEST(KnownBases, LagrangeAndHermiteReproducePowers) {
  std::mt19937 random(42);
  std::uniform_real_distribution<double> gap(0.2, 1), inside(0, 1);
  for (int degree = 1; degree <= 9; ++degree) {
    std::vector<double> nodes{-1};
    while (std::ssize(nodes) <= degree) nodes.push_back(nodes.back() + gap(random) / degree);
    const LagrangeBasis basis(nodes);
    const double u = inside(random), t = basis.begin() + u * basis.length();
    const WeightRows rows = basis.rows(u, 0);
    for (int k = 0; k <= degree; ++k) {
      double sum = 0, size = 0;
      for (size_t i = 0; i < nodes.size(); ++i) {
        const double term = rows(0, Eigen::Index(i)) * std::pow(nodes[i], k);
        sum += term, size += std::abs(term);
      }
      EXPECT_NEAR(sum, std::pow(t, k), rounding(4 * degree, size)) << degree << " " << k;
    }
  }
  for (int k = 0; k <= 3; ++k) {
    Points ends(2, 1), slopes(2, 1);
    ends << (k == 0 ? 1 : 0), 1;
    slopes << (k == 1 ? 1 : 0), k;
    const CurveNet curve = hermite_curve(ends, slopes);
    for (const double t : {0.0, 0.3, 1.0}) EXPECT_NEAR(column_at(curve, t)[0], std::pow(t, k), rounding(8)) << k;
  }
}

// (P1, P1 + (P2 - P0)/6, P2 - (P3 - P1)/6, P2), and Coons' ((P0 + 4 P1 + P2)/6, (2 P1 + P2)/3, ..).
TEST(KnownBases, CardinalAndCoonsPiecesHaveTheirBezierPoints) {
  const double catmull_rom[4][4] = {{0, 1, 0, 0}, {-1 / 6., 1, 1 / 6., 0}, {0, 1 / 6., 1, -1 / 6.}, {0, 0, 1, 0}};
  const double coons[4][4] = {
      {1 / 6., 4 / 6., 1 / 6., 0}, {0, 2 / 3., 1 / 3., 0}, {0, 1 / 3., 2 / 3., 0}, {0, 1 / 6., 4 / 6., 1 / 6.}};
  const double coons_powers[] = {1 / 6., -0.5, 0.5, -1 / 6., 4 / 6., 0, -1, 0.5,
                                 1 / 6., 0.5,  0.5, -0.5,    0,      0, 0,  1 / 6.};
  const WeightRows cardinal_points = SegmentBasis::cardinal({0, 1}).to_bezier(),
                   coons_points = SegmentBasis(3, 1, coons_powers, {0, 1}).to_bezier();
  for (Eigen::Index b = 0; b < 4; ++b)
    for (Eigen::Index i = 0; i < 4; ++i) {
      EXPECT_NEAR(cardinal_points(b, i), catmull_rom[b][i], rounding(4));
      EXPECT_NEAR(coons_points(b, i), coons[b][i], rounding(4));
    }
}

/// A row more at both ends, 2 p_0 - p_1, of points that lie `stride` apart.
Points with_phantoms(const Points& net, Index m, Index n) {
  Points more((m + 2) * (n + 2), 3);
  const auto row = [&](Index i, Index j) { return more.row((i + 1) + (m + 2) * (j + 1)); };
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < m; ++i) row(i, j) = net.row(i + m * j);
    row(-1, j) = 2 * row(0, j) - row(1, j);
    row(m, j) = 2 * row(m - 1, j) - row(m - 2, j);
  }
  for (Index i = -1; i <= m; ++i) {
    row(i, -1) = 2 * row(i, 0) - row(i, 1);
    row(i, n) = 2 * row(i, n - 1) - row(i, n - 2);
  }
  return more;
}

TEST(KnownBases, OpenGridsUnderCatmullClarkAreBsplinesOverPhantomPoints) {
  std::mt19937 random(43);
  std::uniform_real_distribution<double> inside(0, 1);
  for (const auto& [m, n] : {std::pair<Index, Index>(2, 2), {5, 4}, {3, 7}}) {
    Mesh mesh;
    mesh.positions = random_points(random, m * n, 3);
    for (Index j = 0; j + 1 < n; ++j)
      for (Index i = 0; i + 1 < m; ++i) {
        mesh.face_sizes.push_back(4);
        const Index first = i + m * j;
        mesh.face_vertices.insert(mesh.face_vertices.end(), {first, first + 1, first + 1 + m, first + m});
      }
    const LimitMap limit(find_scheme("catmull-clark").value(), mesh);
    const auto uniform = [](Index points) {
      std::vector<double> knots;
      for (Index i = 0; i < points + 6; ++i) knots.push_back(i);
      return Knots<double>::open(3, points + 2, std::move(knots));
    };
    const SplineSurface spline(uniform(m), uniform(n));
    const Points columns = with_phantoms(mesh.positions, m, n);
    ASSERT_EQ(spline.num_faces(), Index(mesh.face_sizes.size()));
    for (int k = 0; k < 100; ++k) {
      const auto parameter = [&] { return k % 5 == 0 ? double(random() % 2) : inside(random); };
      const Place s{static_cast<Index>(random() % unsigned(spline.num_faces())), parameter(), parameter()};
      const LimitSamples a = spline.evaluate(columns, {&s, 1}, 1), b = limit.evaluate(mesh.positions, {&s, 1}, 1);
      EXPECT_LE((a.position - b.position).norm(), reference) << m << " x " << n << " " << s.face;
      EXPECT_LE((a.du - b.du).norm() + (a.dv - b.dv).norm(), first_derivative * (1 + a.du.norm() + a.dv.norm()));
    }
    // Corners are interpolated, and across its sides the surface does not bend.
    const Place corner{0, 0, 0}, side{0, 0, 0.4};
    EXPECT_LE((spline.evaluate(columns, {&corner, 1}).position - mesh.positions.row(0)).norm(), rounding(16));
    EXPECT_LE(spline.evaluate(columns, {&side, 1}, 2).duu.norm(), rounding(16, 8));
  }
}

}  // namespace
}  // namespace sublimit::testing
