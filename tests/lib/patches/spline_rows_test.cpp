// SPDX-License-Identifier: Apache-2.0
// Rows of points and derivatives: laws in exact fractions, and doubles against 256-bit truth.
#include "sublimit/patches/detail/spline_rows.h"

#include <gtest/gtest.h>

#include "support/tolerance.h"
#include "truth/classical_splines.h"
#include "truth/fraction.h"
#include "truth/precise.h"

namespace sublimit::testing {
namespace {

/// Of derivatives, relative to the sum of the absolute values of their terms.
constexpr double derivative_tolerance = 1e-12;

template <class T>
std::vector<T> rows_at(const Knots<T>& knots, Index face, const T& u, int order) {
  std::vector<T> rows(static_cast<size_t>(order + 1) * (knots.degree() + 1));
  span_rows(knots, face, u, order, std::span<T>(rows));
  return rows;
}

/// Weights over all functions.
template <class T>
std::vector<T> spread(const Knots<T>& knots, Index face, std::span<const T> row) {
  std::vector<T> all(knots.num_functions(), T(0));
  std::copy(row.begin(), row.end(), all.begin() + (knots.span(face) - knots.degree()));
  return all;
}

TEST(SplineRows, AreHodographsInFractions) {
  std::mt19937 random(3);
  for (int degree = 0; degree <= 9; ++degree)
    for (int repeat = 0; repeat < 8; ++repeat) {
      const auto knots = random_knots<Fraction>(random, degree, repeat % 4 == 3);
      for (Index face = 0; face < knots.num_faces(); ++face)
        for (const Fraction& u : {Fraction(0), Fraction(1), Fraction(3, 7)}) {
          const Fraction h = knots.length(face);
          const std::vector<Fraction> rows = rows_at(knots, face, u, 2);
          Fraction scale(1);
          for (int r = 0; r <= 2; ++r, scale *= h) {
            const auto row = std::span<const Fraction>(rows).subspan(r * (degree + 1), degree + 1);
            std::vector<Fraction> expected =
                hodograph_row(knots.all(), degree, knots.span(face), r, knots.parameter({face, u}));
            for (Fraction& weight : expected) weight *= scale;
            EXPECT_EQ(spread(knots, face, row), expected) << degree << ", order " << r;
          }
        }
    }
}

TEST(SplineRows, SumToOneAndZeroAndAreNotNegative) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> inside(0, 1);
  for (int degree = 0; degree <= 9; ++degree)
    for (int repeat = 0; repeat < 20; ++repeat) {
      const auto knots = random_knots<double>(random, degree, repeat % 4 == 3);
      for (Index face = 0; face < knots.num_faces(); ++face)
        for (const double u : {0.0, 1e-300, 1e-12, inside(random), 1 - eps / 2, 1.0}) {
          const std::vector<double> rows = rows_at(knots, face, u, 2);
          double sums[3] = {0, 0, 0}, sizes[3] = {0, 0, 0};
          for (size_t i = 0; i < rows.size(); ++i) {
            const size_t r = i / (degree + 1);
            sums[r] += rows[i], sizes[r] += std::abs(rows[i]);
            if (r == 0) {
              EXPECT_GE(rows[i], 0);
            }
          }
          EXPECT_NEAR(sums[0], 1, rounding(degree + 1));
          for (const int r : {1, 2}) EXPECT_NEAR(sums[r], 0, rounding(degree + 1, sizes[r]));
        }
    }
}

TEST(SplineRows, OfTheEndsAreControlPointsAndTheirDifferences) {
  for (int degree = 1; degree <= 9; ++degree) {
    const auto knots = bezier_knots<Fraction>(degree);
    for (const int end : {0, 1}) {
      const std::vector<Fraction> rows = rows_at(knots, 0, Fraction(end), 2);
      for (int i = 0; i <= degree; ++i) {
        const int from_end = end == 0 ? i : degree - i, sign = end == 0 ? 1 : -1;
        EXPECT_EQ(rows[i], from_end == 0 ? 1 : 0);
        EXPECT_EQ(rows[degree + 1 + i], sign * degree * (from_end == 0 ? -1 : from_end == 1 ? 1 : 0));
        EXPECT_EQ(rows[2 * degree + 2 + i], degree * (degree - 1) *
                                                (from_end == 1                    ? -2
                                                 : from_end == 0 || from_end == 2 ? 1
                                                                                  : 0));
      }
    }
  }
}

TEST(SplineRows, OfBezierKnotsAreBernsteinPolynomials) {
  for (int degree = 0; degree <= 9; ++degree) {
    const Fraction u(5, 13);
    const std::vector<Fraction> row = rows_at(bezier_knots<Fraction>(degree), 0, u, 0);
    // De Casteljau's algorithm on unit points.
    for (int i = 0; i <= degree; ++i) {
      std::vector<Fraction> points(degree + 1, Fraction(0));
      points[i] = 1;
      for (int r = degree; r > 0; --r)
        for (int j = 0; j < r; ++j) points[j] = (1 - u) * points[j] + u * points[j + 1];
      EXPECT_EQ(row[i], points[0]);
    }
  }
}

// (1-t)^3, 3t^3 - 6t^2 + 4, -3t^3 + 3t^2 + 3t + 1, t^3, over 6: Coons' cubic.
TEST(SplineRows, OfUniformCubicsAreCoonsCubics) {
  const auto knots = Knots<Fraction>::open(3, 4, {0, 1, 2, 3, 4, 5, 6, 7});
  const Fraction t(3, 10);
  const std::vector<Fraction> row = rows_at(knots, 0, t, 0);
  EXPECT_EQ(row[0] * 6, (1 - t) * (1 - t) * (1 - t));
  EXPECT_EQ(row[1] * 6, 3 * t * t * t - 6 * t * t + 4);
  EXPECT_EQ(row[2] * 6, -3 * t * t * t + 3 * t * t + 3 * t + 1);
  EXPECT_EQ(row[3] * 6, t * t * t);
}

TEST(SplineRows, OfBothSidesOfAKnotAgreeAsFarAsItsMultiplicityLets) {
  std::mt19937 random(5);
  int jumps[4] = {0, 0, 0, 0};
  for (int degree = 0; degree <= 9; ++degree)
    for (int repeat = 0; repeat < 12; ++repeat) {
      const auto knots = random_knots<Fraction>(random, degree, repeat % 2 == 1);
      for (Index face = 0; face < knots.num_faces(); ++face) {
        const std::optional<int> continuity = knots.continuity(face, KnotSide::right);
        if (!continuity) continue;
        const Index next = (face + 1) % knots.num_faces();
        // Over the control points, which closed splines use several times.
        const auto over_points = [&](Index of_face, const Fraction& u, int r) {
          const std::vector<Fraction> rows = rows_at(knots, of_face, u, 2);
          std::vector<Fraction> all(knots.num_points(), Fraction(0));
          Fraction scale(1);
          for (int k = 0; k < r; ++k) scale *= knots.length(of_face);
          for (Index i = 0; i <= degree; ++i)
            all[knots.point(knots.span(of_face) - degree + i)] += rows[r * (degree + 1) + i] / scale;
          return all;
        };
        const bool every_function_has_its_point = knots.num_points() > 2 * degree + 1;
        for (int r = 0; r <= 2; ++r) {
          const bool equal = over_points(face, Fraction(1), r) == over_points(next, Fraction(0), r);
          if (r <= *continuity) {
            EXPECT_TRUE(equal);
          }
          if (r == *continuity + 1 && every_function_has_its_point) {
            EXPECT_FALSE(equal);
            ++jumps[r];
          }
        }
      }
    }
  for (const int r : {0, 1, 2}) EXPECT_GT(jumps[r], 5) << r;
}

/// Double rows over random control points against 256 bits. Closed knots are compared as the doubles that they are.
struct Errors {
  double points = 0, derivatives[3] = {0, 0, 0};
};
template <class Draw>
Errors errors_of_rows(std::mt19937& random, const Knots<double>& knots, const Draw& draw) {
  const int degree = knots.degree();
  const auto precise = Knots<Precise>::open(degree, knots.num_functions(), {knots.all().begin(), knots.all().end()});
  std::uniform_real_distribution<double> coordinate(-1, 1);
  Errors errors;
  for (Index face = 0; face < knots.num_faces(); ++face)
    for (const double u : {0.0, 1e-12, draw(), draw(), 1 - 1e-12, 1.0}) {
      const std::vector<double> rows = rows_at(knots, face, u, 2);
      const std::vector<Precise> truth = rows_at(precise, face, Precise(u), 2);
      std::vector<double> x(degree + 1);
      for (double& value : x) value = coordinate(random);
      for (int r = 0; r <= 2; ++r) {
        double sum = 0, size = 0;
        Precise right = 0;
        for (int i = 0; i <= degree; ++i) {
          const size_t at = r * (degree + 1) + i;
          sum += rows[at] * x[i], size += std::abs(rows[at] * x[i]), right += truth[at] * Precise(x[i]);
        }
        const double error = static_cast<double>(abs(Precise(sum) - right));
        if (size == 0) {
          EXPECT_EQ(error, 0);
        }
        if (size == 0) continue;
        if (r == 0) errors.points = std::max(errors.points, error / (eps * size));
        if (r > 0) errors.derivatives[r] = std::max(errors.derivatives[r], error / size);
      }
    }
  return errors;
}

TEST(SplineRows, AgreeWith256Bits) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> inside(0, 1), gap(-12, 0);
  Errors largest;
  for (int degree = 1; degree <= 9; ++degree)
    for (int repeat = 0; repeat < 60; ++repeat) {
      Knots<double> knots = random_knots<double>(random, degree, repeat % 4 == 3);
      if (repeat % 2 == 0) {  // spans of very different lengths, and knots that are no short fractions
        std::vector<double> all(knots.all().begin(), knots.all().end()), given = all;
        for (size_t i = 1; i < all.size(); ++i)
          all[i] = given[i] == given[i - 1] ? all[i - 1] : all[i - 1] + std::exp(gap(random));
        knots = Knots<double>::open(degree, knots.num_functions(), all);
      }
      const Errors errors = errors_of_rows(random, knots, [&] { return inside(random); });
      EXPECT_LE(errors.points, 4) << "in eps, of degree " << degree;
      for (const int r : {1, 2}) EXPECT_LE(errors.derivatives[r], derivative_tolerance) << degree << ", order " << r;
      largest.points = std::max(largest.points, errors.points);
      for (const int r : {1, 2}) largest.derivatives[r] = std::max(largest.derivatives[r], errors.derivatives[r]);
    }
  RecordProperty("points_in_eps", std::to_string(largest.points));
  for (const int r : {1, 2})
    RecordProperty("order_" + std::to_string(r) + "_in_eps", std::to_string(largest.derivatives[r] / eps));
}

}  // namespace
}  // namespace sublimit::testing
