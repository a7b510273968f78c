// SPDX-License-Identifier: Apache-2.0
// What is known of the smoothness of curve schemes, found from their masks.
#include "sublimit/certificates/regularity/curve_regularity.h"
#include "support/tolerance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sublimit {
namespace {

using Answer = Verdict::Answer;

/// The four-point mask with w = p/q, for any w.
Symbol four_point_symbol(int p, int q) {
  const Rational w = Rational(p) / q, half = Rational(1) / 2;
  Symbol a;
  a.first = -3;
  a.coefficients = {-w, 0, half + w, 1, half + w, 0, -w};
  return a;
}

CurveRegularity named(const std::string& name, const SchemeOptions& options = {}) {
  const std::optional<CurveRegularity> r = curve_regularity(name, options);
  EXPECT_TRUE(r) << name;
  return r.value_or(CurveRegularity{});
}

Answer answer(const CurveRegularity& r, const std::string& says) {
  for (const Verdict& v : r.verdicts)
    if (v.property == "regular-smoothness" && v.says == says) return v.answer;
  return Answer::unknown;
}

TEST(CurveRegularity, SplinesHaveTheExponentOfTheirDegree) {
  for (int degree = 1; degree <= 15; ++degree) {
    const CurveRegularity r = named("lane-riesenfeld", {{"degree", std::to_string(degree)}});
    EXPECT_EQ(r.sum_rules, degree + 1);
    EXPECT_EQ(r.smoothness.continuity, degree - 1);
    EXPECT_EQ(r.smoothness.exponent_low, degree);  // powers of two: exact
    EXPECT_EQ(r.smoothness.exponent_high, degree);
    EXPECT_EQ(r.degrees.generates, degree);
    EXPECT_EQ(r.degrees.reproduces, 1);
    EXPECT_EQ(r.support[1] - r.support[0], Rational(degree + 1));
    EXPECT_EQ(r.support[0], -r.support[1]);
    EXPECT_EQ(answer(r, "C^" + std::to_string(degree)), Answer::disproved);
  }
  EXPECT_EQ(named("chaikin").smoothness.exponent_high, 2);
}

// Points are doubled, 1 + z, and averaged `degree` times, (1 + z)/2 each. Midpoints that are inserted are the first of
// these averagings: n more of them make degree n + 1.
TEST(CurveRegularity, LaneRiesenfeldAveragesDoubledPoints) {
  std::vector<Rational> mask{1, 1};
  for (int degree = 1; degree <= 15; ++degree) {
    mask.push_back(0);
    for (size_t i = mask.size() - 1; i > 0; --i) mask[i] = (mask[i] + mask[i - 1]) / 2;
    mask[0] = mask[0] / 2;
    EXPECT_EQ(named("lane-riesenfeld", {{"degree", std::to_string(degree)}}).mask.coefficients, mask) << degree;
  }
}

TEST(CurveRegularity, FourPointNormOfTwoStepsIsOneWhereItShouldBe) {
  // C^1: w = (sqrt 5 - 1)/8; C^0: w = (sqrt 13 - 1)/8 and -3/8 (where it is 1 exactly).
  const double c1 = (std::sqrt(5.0) - 1) / 8, c0 = (std::sqrt(13.0) - 1) / 8;
  const auto norm = [](double w, int order) {
    return difference_norm(four_point_symbol(static_cast<int>(std::lround(w * 1e6)), 1000000), order, 2);
  };
  constexpr double step = 2e-6;
  EXPECT_LT(norm(c1 - step, 2).norm.upper(), 1);
  EXPECT_GT(norm(c1 + step, 2).norm.lower(), 1);
  EXPECT_LT(norm(c0 - step, 1).norm.upper(), 1);
  EXPECT_GT(norm(c0 + step, 1).norm.lower(), 1);
  const DifferenceNorm end = difference_norm(four_point_symbol(-3, 8), 1, 2);
  EXPECT_EQ(end.norm.lower(), 1);
  EXPECT_EQ(end.norm.upper(), 1);
  EXPECT_LT(norm(-0.375 + step, 1).norm.upper(), 1);
}

TEST(CurveRegularity, FourPointIsC1UpToTheEndOfItsRange) {
  // The end: 32 w^3 + 4 w = 1, tension 16 w = 3.08367.
  for (const int thousandths : {1, 500, 1000, 2000, 2472, 2900, 3000, 3080, 3083}) {
    const CurveRegularity r = curve_regularity(four_point_symbol(thousandths, 16000));
    EXPECT_EQ(r.smoothness.continuity, 1) << thousandths;
    EXPECT_EQ(answer(r, "C^1"), Answer::proved) << thousandths;
    EXPECT_EQ(answer(r, "C^2"), Answer::disproved) << thousandths;
  }
  for (const int thousandths : {-3000, -100, -1, 0, 3084, 3100, 4000, 6000}) {
    const CurveRegularity r = curve_regularity(four_point_symbol(thousandths, 16000));
    EXPECT_EQ(answer(r, "C^1"), Answer::disproved) << thousandths;
    EXPECT_EQ(r.smoothness.continuity, 0) << thousandths;
  }
  EXPECT_EQ(curve_regularity(four_point_symbol(1, 2)).smoothness.possible, -1);  // not even continuous
  EXPECT_EQ(curve_regularity(four_point_symbol(-1, 2)).smoothness.possible, -1);
}

TEST(CurveRegularity, ExponentsAreEnclosed) {
  const auto expect = [](const CurveRegularity& r, double exponent, double width) {
    EXPECT_LE(r.smoothness.exponent_low, exponent);
    EXPECT_GE(r.smoothness.exponent_high, exponent);
    EXPECT_LT(r.smoothness.exponent_high - r.smoothness.exponent_low, width);
    EXPECT_TRUE(r.smoothness.has_upper_bound);
  };
  constexpr double narrow = 2e-6;  // the slack of the polytope, as an exponent
  expect(named("six-point"), -std::log2(9.0 / 64), narrow);
  expect(named("four-point"), 2, narrow);
  expect(named("four-point", {{"tension", "0.5"}}), -std::log2((1 + std::sqrt(0.5)) / 4), narrow);
  // Eight points (Deslauriers, Dubuc): -5, 49, -245, 1225 over 2048.
  Symbol eight;
  eight.first = -7;
  for (const int c : {-5, 0, 49, 0, -245, 0, 1225, 2048, 1225, 0, -245, 0, 49, 0, -5})
    eight.coefficients.push_back(Rational(c) / 2048);
  const CurveRegularity r = curve_regularity(eight);
  EXPECT_EQ(r.sum_rules, 8);
  EXPECT_EQ(r.smoothness.continuity, 3);
  EXPECT_NEAR(r.smoothness.exponent_low, 3.551131, testing::seven_digits);
  EXPECT_NEAR(r.smoothness.exponent_high, 3.551131, testing::seven_digits);
}

TEST(CurveRegularity, TensionOneIsNeverC2) {
  const CurveRegularity r = named("four-point");
  EXPECT_EQ(r.sum_rules, 4);
  EXPECT_EQ(r.degrees.reproduces, 3);
  EXPECT_EQ(answer(r, "C^2"), Answer::disproved);
  for (const Verdict& v : r.verdicts)
    for (const Hypothesis& h : v.hypotheses) EXPECT_NE(h.by, Hypothesis::By::floating);
}

TEST(CurveRegularity, PerturbedMasksLoseTheirVerdicts) {
  Symbol a = four_point_symbol(1, 16);
  a.coefficients[2] += Rational(1) / 1000;  // no longer sums to one
  const CurveRegularity broken = curve_regularity(a);
  EXPECT_EQ(broken.verdicts[0].answer, Answer::disproved);
  EXPECT_EQ(broken.smoothness.continuity, -1);
  a.coefficients[4] -= Rational(1) / 1000;  // sums to one, but lines are not generated
  const CurveRegularity bent = curve_regularity(a);
  EXPECT_EQ(bent.sum_rules, 1);
  EXPECT_EQ(answer(bent, "C^1"), Answer::disproved);
}

TEST(CurveRegularity, MasksThatDependOnTheLevelAreEvidence) {
  const CurveRegularity r = named("trigonometric-cubic");
  EXPECT_EQ(r.smoothness.continuity, 2);
  for (const Verdict& v : r.verdicts) EXPECT_NE(v.answer, Answer::proved);
  EXPECT_FALSE(curve_regularity("hermite-merrien"));
  EXPECT_FALSE(curve_regularity("loop"));
}

TEST(CurveRegularity, DependentShiftsAreSeen) {
  // (1 + z)(1 + z^2)/2, twice the pace: the box function of two edges; its shifts satisfy sum (-1)^i phi(x - i) = 0.
  Symbol a;
  a.coefficients = {Rational(1) / 2, Rational(1) / 2, Rational(1) / 2, Rational(1) / 2};
  EXPECT_FALSE(has_independent_shifts(a));
  EXPECT_TRUE(has_independent_shifts(four_point_symbol(1, 16)));
  // (1 + z + z^2) of order 3 has common zeros with nothing, but 1 - z + z^2 (order 6) divides this one:
  Symbol cyclotomic;  // (1 + z)(1 - z + z^2) = 1 + z^3: the box function of three edges
  cyclotomic.coefficients = {1, 0, 0, 1};
  EXPECT_FALSE(has_independent_shifts(cyclotomic));
}

TEST(CurveRegularity, SamplesOfTheBasisFunctionAreItsLimits) {
  const BasisSamples cubic = basis_samples(named("lane-riesenfeld").mask, 4);
  ASSERT_EQ(cubic.x.size(), 65u);
  EXPECT_EQ(cubic.x.front(), -2);
  EXPECT_NEAR(cubic.value[32], 2.0 / 3, testing::other_route);
  EXPECT_NEAR(cubic.value[16], 1.0 / 6, testing::other_route);
  EXPECT_NEAR(cubic.derivative[16], 0.5, testing::other_route);
  const BasisSamples six = basis_samples(named("six-point").mask, 2);
  EXPECT_NEAR(six.value[six.value.size() / 2], 1, testing::other_route);
  EXPECT_NEAR(six.derivative[4 * 4], 272.0 / 365, testing::first_derivative);  // one edge before the point
}

}  // namespace
}  // namespace sublimit
