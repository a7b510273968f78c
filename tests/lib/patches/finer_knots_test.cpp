// SPDX-License-Identifier: Apache-2.0
// Other nets of the same curve: in exact fractions row_fine(t) S = row_coarse(t), and S is what the classical
// algorithms give.
#include "sublimit/patches/detail/finer_knots.h"

#include <gtest/gtest.h>

#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/patches/detail/spline_rows.h"
#include "support/expect_error.h"
#include "support/tolerance.h"
#include "truth/classical_splines.h"
#include "truth/fraction.h"
#include "truth/precise.h"

namespace sublimit::testing {
namespace {

template <class T>
using Matrix = std::vector<std::vector<T>>;

/// Over the control points.
template <class T>
Matrix<T> dense(const BandRows<T>& rows, const Knots<T>& knots) {
  Matrix<T> result;
  for (Index r = 0; r < rows.size(); ++r) {
    result.emplace_back(knots.num_points(), T(0));
    for (Index i = 0; i < rows.width; ++i) result[r][knots.point(rows.first[r] + i)] += rows[r][i];
  }
  return result;
}
template <class T>
std::vector<T> row_at(const Knots<T>& knots, const T& t, KnotSide side) {
  const KnotPlace<T> place = knots.place(t, side);
  BandRows<T> row{.width = knots.degree() + 1};
  span_rows(knots, place.face, place.u, 0, row.add(knots.span(place.face) - knots.degree()));
  return dense(row, knots)[0];
}
template <class T>
std::vector<T> combined(const std::vector<T>& row, const Matrix<T>& S) {
  std::vector<T> result(S.empty() ? 0 : S[0].size(), T(0));
  for (size_t i = 0; i < row.size(); ++i)
    for (size_t j = 0; j < result.size(); ++j) result[j] += row[i] * S[i][j];
  return result;
}

/// Knots that are finer in every way that there is.
std::vector<std::pair<std::string, Knots<Fraction>>> all_finer(std::mt19937& random, const Knots<Fraction>& knots) {
  std::vector<std::pair<std::string, Knots<Fraction>>> result;
  const Index face = static_cast<Index>(random() % knots.num_faces());
  const Fraction inside = knots.parameter({face, Fraction(1 + static_cast<int>(random() % 5)) / 6});
  result.emplace_back("a knot", with_knot(knots, inside, 1 + static_cast<int>(random() % (knots.degree() + 1))));
  result.emplace_back("halves", halved_knots(knots));
  result.emplace_back("quarters", halved_knots(halved_knots(knots)));
  result.emplace_back("clamped", clamped_knots(knots));
  result.emplace_back("Bezier pieces", bezier_pieces(knots));
  if (knots.degree() < 9) result.emplace_back("elevated", elevated_knots(knots));
  std::vector<Fraction> before(knots.degree(), knots.begin()), after(knots.degree(), knots.end());
  for (int i = 0; i < knots.degree(); ++i) {
    before[i] -= Fraction(knots.degree() - i, 3);
    after[i] += Fraction(i + 1, 5);
  }
  result.emplace_back("other ends", with_end_knots(knots, before, after));
  return result;
}

BandRows<Fraction> rows_to(const Knots<Fraction>& coarse, const Knots<Fraction>& fine) {
  return fine.degree() > coarse.degree() ? elevation_rows(coarse, fine) : refinement_rows(coarse, fine);
}

TEST(FinerKnots, LeaveTheCurveAsItIs) {
  std::mt19937 random(7);
  for (int degree = 0; degree <= 9; ++degree)
    for (int repeat = 0; repeat < 6; ++repeat) {
      const auto knots = random_knots<Fraction>(random, degree, repeat % 2 == 1);
      for (const auto& [name, fine] : all_finer(random, knots)) {
        const Matrix<Fraction> S = dense(rows_to(knots, fine), knots);
        ASSERT_EQ(std::ssize(S), fine.num_points());
        for (Index face = 0; face < fine.num_faces(); ++face)
          for (const Fraction& u : {Fraction(0), Fraction(2, 7), Fraction(1)}) {
            const Fraction t = fine.parameter({face, u});
            const KnotSide side = u == 1 ? KnotSide::left : KnotSide::right;
            EXPECT_EQ(combined(row_at(fine, t, side), S), row_at(knots, t, side))
                << name << ", degree " << degree << (knots.is_closed() ? ", closed" : "");
          }
      }
    }
}

TEST(FinerKnots, AreConvexCombinationsAlsoRounded) {
  std::mt19937 random(8);
  for (int degree = 0; degree <= 9; ++degree)
    for (int repeat = 0; repeat < 12; ++repeat) {
      const auto exact = random_knots<Fraction>(random, degree, repeat % 2 == 1);
      std::vector<double> values;
      for (const Fraction& t : exact.is_closed() ? exact.in_domain() : exact.all())
        values.push_back(static_cast<double>(t) / 3);
      const auto knots = exact.is_closed() ? Knots<double>::closed(degree, values)
                                           : Knots<double>::open(degree, exact.num_points(), values);
      const double inside = knots.parameter({0, 0.3});
      for (const Knots<double>& fine : {with_knot(knots, inside), halved_knots(knots), clamped_knots(knots),
                                        bezier_pieces(knots), elevated_knots(knots)}) {
        const SparseMatrix S = refinement_matrix(knots, fine);
        EXPECT_EQ(S.rows(), fine.num_points());
        EXPECT_EQ(S.cols(), knots.num_points());
        for (Eigen::Index r = 0; r < S.rows(); ++r) {
          double sum = 0;
          for (SparseMatrix::InnerIterator term(S, r); term; ++term) {
            EXPECT_GT(term.value(), 0);
            sum += term.value();
          }
          EXPECT_NEAR(sum, 1, rounding(degree + 1));
        }
      }
    }
}

TEST(FinerKnots, RowsAgreeWith256Bits) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> gap(-8, 0);
  double largest = 0;
  for (int degree = 1; degree <= 9; ++degree)
    for (int repeat = 0; repeat < 20; ++repeat) {
      const auto given = random_knots<double>(random, degree);
      std::vector<double> all(given.all().begin(), given.all().end());
      for (size_t i = 1; i < all.size(); ++i)
        all[i] = given.all()[i] == given.all()[i - 1] ? all[i - 1] : all[i - 1] + std::exp(gap(random));
      const auto knots = Knots<double>::open(degree, given.num_points(), all);
      const auto precise = [](const Knots<double>& k) {
        return Knots<Precise>::open(k.degree(), k.num_points(), {k.all().begin(), k.all().end()});
      };
      for (const Knots<double>& fine : {halved_knots(knots), bezier_pieces(knots)}) {
        const BandRows<double> rows = refinement_rows(knots, fine);
        const BandRows<Precise> truth = refinement_rows(precise(knots), precise(fine));
        ASSERT_EQ(rows.first, truth.first);
        for (Index r = 0; r < rows.size(); ++r)
          for (Index i = 0; i < rows.width; ++i)
            if (const double error = static_cast<double>(abs(Precise(rows[r][i]) - truth[r][i])); error > 0)
              largest = std::max(largest, error / rows[r][i] / eps);
      }
    }
  EXPECT_LE(largest, 1) << "in eps, of every weight by itself";
  RecordProperty("in_eps", std::to_string(largest));
}

TEST(FinerKnots, OneMoreIsBoehmsInsertion) {
  std::mt19937 random(10);
  for (int degree = 1; degree <= 9; ++degree)
    for (int repeat = 0; repeat < 30; ++repeat) {
      const auto knots = random_knots<Fraction>(random, degree);
      // Boehm keeps control points that have no influence in the domain.
      if (knots.span(0) > degree || knots.span(knots.num_faces() - 1) + 1 < knots.num_points()) continue;
      const Index face = static_cast<Index>(random() % knots.num_faces());
      const Fraction s = knots.parameter({face, Fraction(static_cast<int>(random() % 3 + 1), 4)});
      const Matrix<Fraction> S = dense(refinement_rows(knots, with_knot(knots, s)), knots);
      for (Index column = 0; column < knots.num_points(); ++column) {
        std::vector<Fraction> unit(knots.num_points(), Fraction(0));
        unit[column] = 1;
        const std::vector<Fraction> expected = boehm(knots.all(), degree, knots.span(face), unit, s);
        for (size_t r = 0; r < S.size(); ++r) EXPECT_EQ(S[r][column], expected[r]);
      }
    }
}

TEST(FinerKnots, AreDiscreteSplinesByOslo) {
  std::mt19937 random(11);
  for (int degree = 1; degree <= 7; ++degree)
    for (int repeat = 0; repeat < 4; ++repeat) {
      const auto knots = clamped_knots(random_knots<Fraction>(random, degree));
      const Knots<Fraction> fine = repeat % 2 == 0 ? halved_knots(knots) : bezier_pieces(knots);
      const Matrix<Fraction> S = dense(refinement_rows(knots, fine), knots);
      for (Index j = 0; j < fine.num_points(); ++j)
        for (Index i = 0; i < knots.num_points(); ++i)
          EXPECT_EQ(S[j][i], oslo(knots.all(), fine.all(), i, degree, j)) << degree << ": " << j << ", " << i;
    }
}

TEST(FinerKnots, MayComeInAnyOrder) {
  std::mt19937 random(12);
  for (int degree = 1; degree <= 9; ++degree) {
    const auto knots = random_knots<Fraction>(random, degree, degree % 2 == 1);
    const Fraction a = knots.parameter({0, Fraction(1, 3)});
    const Fraction b = knots.parameter({knots.num_faces() - 1, Fraction(4, 5)});
    const auto through = [&](const Fraction& first, const Fraction& second) {
      const Knots<Fraction> middle = with_knot(knots, first), fine = with_knot(middle, second);
      const Matrix<Fraction> S = dense(refinement_rows(knots, middle), knots);
      Matrix<Fraction> both;
      for (const std::vector<Fraction>& row : dense(refinement_rows(middle, fine), middle))
        both.push_back(combined(row, S));
      return both;
    };
    const Matrix<Fraction> at_once = dense(refinement_rows(knots, with_knot(with_knot(knots, a), b)), knots);
    EXPECT_EQ(through(a, b), at_once);
    EXPECT_EQ(through(b, a), at_once);
  }
}

TEST(FinerKnots, HalfwayBetweenUniformOnesAreMasksOfLaneAndRiesenfeld) {
  for (int degree = 0; degree <= 9; ++degree) {
    std::vector<double> all;
    for (int i = 0; i < 3 * degree + 6; ++i) all.push_back(i);
    const auto open = Knots<double>::open(degree, 2 * degree + 5, all);
    const auto closed = Knots<double>::closed(degree, {all.begin(), all.begin() + 3 * degree + 6});
    for (const Knots<double>& knots : {open, closed}) {
      const BandRows<double> rows = refinement_rows(knots, halved_knots(knots));
      EXPECT_EQ(rows.size(), knots.is_closed() ? 2 * knots.num_points() : 2 * knots.num_points() - degree);
      double binomial[11] = {1};  // C(p + 1, k)
      for (int k = 0; k <= degree; ++k) binomial[k + 1] = binomial[k] * (degree + 1 - k) / (k + 1);
      for (Index r = 0; r < rows.size(); ++r)
        for (Index i = 0; i < rows.width; ++i) {
          // Function r of the halves lies at half steps: its knots begin at (r + p)/2, those of function c at c.
          const Index k = r + degree - 2 * (rows.first[r] + i);
          EXPECT_EQ(rows[r][i], k >= 0 && k <= degree + 1 ? std::ldexp(binomial[k], -degree) : 0) << degree;
        }
    }
  }
}

TEST(FinerKnots, OfBezierCurvesAreHalvesAndHigherDegrees) {
  for (int degree = 1; degree <= 9; ++degree) {
    const auto knots = bezier_knots<Fraction>(degree);
    const Matrix<Fraction> halves = dense(refinement_rows(knots, bezier_pieces(halved_knots(knots))), knots);
    ASSERT_EQ(std::ssize(halves), 2 * degree + 1);
    for (int i = 0; i <= degree; ++i) {  // rows of the left half: C(i, k)/2^i
      Fraction weight = 1;
      for (int k = 0; k < i; ++k) weight /= 2;
      for (int k = 0; k <= degree; ++k) {
        EXPECT_EQ(halves[i][k], k <= i ? weight : Fraction(0));
        EXPECT_EQ(halves[2 * degree - i][degree - k], halves[i][k]);
        weight = weight * (i - k) / (k + 1);
      }
    }
    if (degree == 9) continue;
    const Matrix<Fraction> higher = dense(elevation_rows(knots, elevated_knots(knots)), knots);
    for (int i = 0; i <= degree + 1; ++i)
      for (int k = 0; k <= degree; ++k)
        EXPECT_EQ(higher[i][k], k == i - 1 ? Fraction(i, degree + 1)
                                : k == i   ? Fraction(degree + 1 - i, degree + 1)
                                           : Fraction(0));
  }
}

TEST(FinerKnots, OfAFaceAreItsBezierPiece) {
  std::mt19937 random(13);
  for (int degree = 1; degree <= 9; ++degree) {
    const auto knots = random_knots<Fraction>(random, degree, degree % 3 == 0);
    const auto pieces = bezier_pieces(knots);
    const Matrix<Fraction> all = dense(refinement_rows(knots, pieces), knots);
    const auto bezier = bezier_knots<Fraction>(degree);
    for (Index face = 0; face < knots.num_faces(); ++face) {
      const Matrix<Fraction> piece = dense(bezier_rows(knots, face), knots);
      for (Index i = 0; i <= degree; ++i) EXPECT_EQ(piece[i], all[pieces.span(face) - degree + i]);
      const Fraction u(3, 8);
      EXPECT_EQ(combined(row_at(bezier, u, KnotSide::right), piece),
                row_at(knots, knots.parameter({face, u}), KnotSide::right));
    }
  }
}

// By hand: Coons' cubic over 0..3 is the Bezier curve (P0 + 4 P1 + P2)/6, (2 P1 + P2)/3, (P1 + 2 P2)/3, ..
TEST(FinerKnots, OfAUniformCubicAreItsBezierPoints) {
  const auto knots = Knots<Fraction>::open(3, 4, {0, 1, 2, 3, 4, 5, 6, 7});
  const Matrix<Fraction> piece = dense(bezier_rows(knots, 0), knots);
  EXPECT_EQ(piece[0], (std::vector<Fraction>{{1, 6}, {4, 6}, {1, 6}, 0}));
  EXPECT_EQ(piece[1], (std::vector<Fraction>{0, {2, 3}, {1, 3}, 0}));
  EXPECT_EQ(piece[2], (std::vector<Fraction>{0, {1, 3}, {2, 3}, 0}));
  EXPECT_EQ(piece[3], (std::vector<Fraction>{0, {1, 6}, {4, 6}, {1, 6}}));
}

TEST(FinerKnots, BringTheNetToTheCurveFourTimesAsNearALevel) {
  Knots<double> knots = Knots<double>::open(3, 7, {0, 0, 0, 0, 1, 2, 4, 5, 5, 5, 5});
  Points net(7, 1);
  net << 0, 2, -1, 3, 1, -2, 0;
  double before = 0, ratio = 0;
  for (int level = 0; level < 7; ++level) {
    const std::vector<double> greville = knots.greville();
    double largest = 0;
    for (Index i = 0; i < knots.num_points(); ++i) {
      const std::vector<double> row = row_at(knots, greville[i], KnotSide::right);
      double value = 0;
      for (Index j = 0; j < knots.num_points(); ++j) value += row[j] * net(j, 0);
      largest = std::max(largest, std::abs(value - net(i, 0)));
    }
    ratio = before / largest, before = largest;
    const Knots<double> fine = halved_knots(knots);
    net = apply(refinement_matrix(knots, fine), net);
    knots = fine;
  }
  constexpr double not_yet = 0.2;  // 2.4, 2.7, 3.4, 3.7, ..: a limit, not an identity
  EXPECT_NEAR(ratio, 4, not_yet);
}

TEST(FinerKnots, OfOnePointAreThatPoint) {
  for (int degree = 0; degree <= 9; ++degree) {
    const auto knots = Knots<Fraction>::closed(degree, {Fraction(1, 3), Fraction(2)});
    for (const Fraction& weight : row_at(knots, Fraction(3, 4), KnotSide::right)) EXPECT_EQ(weight, 1);
    for (const auto& row : dense(refinement_rows(knots, halved_knots(knots)), knots)) EXPECT_EQ(row[0], 1);
  }
}

TEST(FinerKnots, ThatAreNotFinerAreRefused) {
  const auto knots = Knots<double>::open(2, 5, {0, 0, 0, 1, 2, 3, 3, 3});
  const auto refused = [&](const Knots<double>& fine, std::initializer_list<std::string_view> parts) {
    expect_error<InvalidParameter>([&] { refinement_matrix(knots, fine); }, parts);
  };
  refused(Knots<double>::open(2, 4, {0, 0, 0, 1, 3, 3, 3}), {"knot 4 is 2", "coarser ones"});
  refused(Knots<double>::open(2, 5, {0, 0, 0, 1, 2, 4, 4, 4}), {"is 4", "end at 3", "same domain"});
  refused(Knots<double>::open(2, 5, {-1, -1, -1, 1, 2, 3, 3, 3}), {"is -1", "end at 0"});
  refused(Knots<double>::open(1, 4, {0, 0, 1, 2, 3, 3}), {"degree 1", "degree 2 is needed"});
  refused(Knots<double>::open(3, 6, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3}), {"knot 3 is 1", "coarser ones"});
  expect_error<InvalidParameter>([&] { with_knot(knots, 3.0); }, {"3", "outside the domain"});
  expect_error<InvalidParameter>([&] { with_knot(knots, -1.0); }, {"-1", "outside the domain"});
  expect_error<InvalidParameter>([&] { with_knot(knots, 1.0, 3); }, {"knot 3 is 1", "occurs 4 times"});
  const auto near = Knots<double>::open(1, 3, {0, 0, 1, 1 + eps, 2});
  expect_error<InvalidParameter>([&] { halved_knots(near); }, {"knot 3 is", "the one before 1", "no number between"});
  expect_error<InvalidParameter>([&] { elevated_knots(bezier_knots<double>(25)); }, {"degree 26"});
}

}  // namespace
}  // namespace sublimit::testing
