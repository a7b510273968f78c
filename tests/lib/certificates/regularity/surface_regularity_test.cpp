// SPDX-License-Identifier: Apache-2.0
// What is known of the smoothness of schemes on regular meshes, found from their masks.
#include "sublimit/certificates/regularity/surface_regularity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "laws/misreadings.h"
#include "sublimit/certificates/regularity/rational_schemes.h"

namespace sublimit {
namespace {

using Answer = Verdict::Answer;

SurfaceRegularity regularity_of(const std::string& name, const SchemeOptions& options = {}) {
  return surface_regularity(regular_mask(*find_scheme<Rational>(name, options)));
}

Answer answer(const SurfaceRegularity& r, int k) {
  for (const Verdict& v : r.verdicts)
    if (v.property == "regular-smoothness" && v.says == "C^" + std::to_string(k)) return v.answer;
  return Answer::unknown;
}

/// Proved C^k, disproved C^(k + 1), and bounds of the exponent around `exponent`.
void expect(const SurfaceRegularity& r, int k, double exponent) {
  EXPECT_EQ(answer(r, k), Answer::proved);
  EXPECT_EQ(answer(r, k + 1), Answer::disproved);
  EXPECT_LE(r.smoothness.exponent_low, exponent);
  EXPECT_GE(r.smoothness.exponent_high, exponent);
  for (const Verdict& v : r.verdicts)
    for (const Hypothesis& h : v.hypotheses) EXPECT_NE(h.by, Hypothesis::By::floating);
}

TEST(SurfaceRegularity, BoxSplinesAreAsSmoothAsTheyAre) {
  expect(regularity_of("catmull-clark"), 2, 3);
  expect(regularity_of("doo-sabin"), 1, 2);
  expect(regularity_of("loop"), 2, 3);
  expect(regularity_of("mid-edge"), 1, 2);
  for (const int degree : {2, 4, 5, 9})
    expect(regularity_of("averaging", {{"degree", std::to_string(degree)}}), degree - 1, degree);
  EXPECT_EQ(regularity_of("mid-edge").degrees.generates, 2);  // although quadratics are not generated level by level
  EXPECT_EQ(regularity_of("loop").degrees.generates, 3);
  EXPECT_EQ(regularity_of("loop").degrees.reproduces, 1);
}

TEST(SurfaceRegularity, InterpolatingSchemesAreOnlyC1) {
  const SurfaceRegularity butterfly = regularity_of("butterfly");
  expect(butterfly, 1, 2);
  EXPECT_EQ(butterfly.smoothness.exponent_high, 2);  // an eigenvalue 1/4 beyond the cubics, exactly
  EXPECT_EQ(butterfly.degrees.reproduces, 3);
  expect(regularity_of("kobbelt"), 1, 2);
  expect(regularity_of("kobbelt", {{"tension", "3"}}), 1, 1.0244);
}

TEST(SurfaceRegularity, PolytopeNormsAreSmallerThanTheEuclideanOne) {
  // The Euclidean norm is above 1/2, and the polytope's only below it where its points are combined with care.
  expect(regularity_of("butterfly", {{"tension", "1/3"}}), 1, 1.138);
}

TEST(SurfaceRegularity, Sqrt3IsC2) {
  const SurfaceRegularity r = regularity_of("sqrt3");
  EXPECT_EQ(answer(r, 2), Answer::proved);
  EXPECT_EQ(answer(r, 3), Answer::disproved);
  // Around the middle of a face two steps have the eigenvalue 1/18: less smooth than around a vertex.
  constexpr double enclosed = 1e-3;  // how far products of so many matrices enclose the exponent
  EXPECT_NEAR(r.smoothness.exponent_high, std::log(18) / std::log(3), enclosed);
}

TEST(SurfaceRegularity, InterpolatorySqrt3IsEnclosed) {
  const SurfaceRegularity r = regularity_of("interpolatory-sqrt3");
  expect(r, 1, 1.5607);
  EXPECT_LT(r.smoothness.exponent_high, 1.561);
  EXPECT_GT(r.smoothness.exponent_low, 1.5);
}

TEST(SurfaceRegularity, Sqrt3WithoutRelaxationDoesNotConverge) {
  // Two steps of centroids alone: the mask of sqrt3 with vertices that stay. One step: vertex 1, three faces 1/3.
  const SurfaceRegularity r = surface_regularity(regular_mask(testing::misread::sqrt3_without_relaxation<Rational>()));
  EXPECT_NE(answer(r, 1), Answer::proved);
  EXPECT_EQ(answer(r, 1), Answer::disproved);
}

TEST(SurfaceRegularity, PerturbedMasksLoseTheirVerdicts) {
  RegularMask<Rational> mask = regular_mask(*find_scheme<Rational>("loop"));
  const Rational little = Rational(1) / 1024;
  mask.weights[{0, 0}] += little;
  EXPECT_EQ(surface_regularity(mask).verdicts[0].answer, Answer::disproved);
  mask.weights[{2, 0}] -= little;  // sums to one, and prefers a direction
  EXPECT_NE(answer(surface_regularity(mask), 1), Answer::proved);
}

TEST(SurfaceRegularity, DifferencesGiveNoBoundBeyondTheirOrder) {
  // Second differences of whatever is smooth shrink by a quarter: that says nothing against C^3.
  RationalMatrix quarter(1, 1);
  quarter(0, 0) = Number<Rational>::ratio(1, 4);
  DifferenceTransitions t{.order = 2, .matrices = {quarter, quarter}, .necessary = true, .stable = false};
  EXPECT_FALSE(smoothness(t, {}, 5).has_upper_bound);
  // Where limits are as smooth as polynomials are generated these bound it, wherever differences stop.
  t.stable = true;
  EXPECT_TRUE(smoothness(t, {}, 5).has_upper_bound);
  EXPECT_EQ(smoothness(t, {}, 5).exponent_high, 5);
  quarter(0, 0) = Number<Rational>::ratio(1, 2);
  t.matrices = {quarter, quarter};
  EXPECT_EQ(smoothness(t, {}, 5).exponent_high, 1);
}

}  // namespace
}  // namespace sublimit
