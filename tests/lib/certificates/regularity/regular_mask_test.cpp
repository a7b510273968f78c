// SPDX-License-Identifier: Apache-2.0
// The masks that schemes have on regular meshes, against symbols multiplied out by hand.
#include "sublimit/neighborhood/regular_mask.h"

#include <gtest/gtest.h>

#include "sublimit/certificates/spectra/exact_schemes.h"
#include "sublimit/certificates/regularity/rational_schemes.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

using Weights = std::map<Offset, Rational>;

RegularMask<Rational> mask_of(const std::string& name, const SchemeOptions& options = {}) {
  return regular_mask(*find_scheme<Rational>(name, options));
}

/// (1 + z^step) times a mask.
Weights times(const Weights& mask, const Offset& step) {
  Weights product = mask;
  for (const auto& [key, weight] : mask) product[{key[0] + step[0], key[1] + step[1]}] += weight;
  return product;
}

/// A product of factors 1 + z^step, divided by `divisor` and moved by `start`.
Weights box(const std::vector<Offset>& steps, int divisor, const Offset& start) {
  Weights mask{{start, Rational(1) / divisor}};
  for (const Offset& step : steps) mask = times(mask, step);
  return mask;
}

TEST(RegularMask, BoxSplinesHaveTheirSymbols) {
  const Offset x{1, 0}, y{0, 1}, diagonal{1, 1}, other{-1, 1};
  EXPECT_EQ(mask_of("bilinear").weights, box({x, x, y, y}, 4, {-1, -1}));
  EXPECT_EQ(mask_of("catmull-clark").weights, box({x, x, x, x, y, y, y, y}, 64, {-2, -2}));
  EXPECT_EQ(mask_of("doo-sabin").weights, box({x, x, x, y, y, y}, 16, {-1, -1}));
  EXPECT_EQ(mask_of("doo-sabin-averaging").weights, mask_of("doo-sabin").weights);
  EXPECT_EQ(mask_of("mid-edge").weights, box({x, y, diagonal, other}, 4, {0, -1}));  // Zwart, Powell
  EXPECT_EQ(mask_of("mid-edge-habib-warren").weights, mask_of("mid-edge").weights);
  EXPECT_EQ(mask_of("loop").weights, box({x, x, y, y, other, other}, 16, {0, -2}));
  EXPECT_EQ(mask_of("loop-warren").weights, mask_of("loop").weights);
  for (const int degree : {2, 3, 4, 5, 6}) {
    std::vector<Offset> steps(degree + 1, x);
    steps.resize(2 * degree + 2, y);
    const int start = -(degree + 1) / 2;
    EXPECT_EQ(mask_of("averaging", {{"degree", std::to_string(degree)}}).weights,
              box(steps, 1 << 2 * degree, {start, start}));
  }
}

TEST(RegularMask, ResiduesSumToOne) {
  for (const Scheme<Rational>& scheme : all_schemes<Rational>()) {
    const RegularMask<Rational> mask = regular_mask(scheme);
    std::map<Offset, Rational> sums;
    for (const auto& [key, weight] : mask.weights) {
      const auto residue = [&](int k) { return (k % mask.dilation + mask.dilation) % mask.dilation; };
      sums[{residue(key[0]), residue(key[1])}] += weight;
    }
    EXPECT_EQ(sums.size(), static_cast<size_t>(mask.dilation * mask.dilation)) << scheme.name;
    for (const auto& [residue, sum] : sums) EXPECT_EQ(sum, Rational(1)) << scheme.name;
    // As many weights on one side as on the other: labels come back after a period.
    Rational moments[2] = {0, 0};
    for (const auto& [key, weight] : mask.weights)
      for (const int k : {0, 1}) moments[k] += Rational(mask.doubled(key)[k]) * weight;
    EXPECT_EQ(moments[0], Rational(0)) << scheme.name;
    EXPECT_EQ(moments[1], Rational(0)) << scheme.name;
  }
}

TEST(RegularMask, IsTheSameInEveryNumberType) {
  const auto check = [](const std::string& name, const SchemeOptions& options = {}) {
    const RegularMask<Algebraic> exact = regular_mask(*find_scheme<Algebraic>(name, options));
    const std::optional<RegularMask<Rational>> ratios = rational_mask(exact);
    ASSERT_TRUE(ratios) << name << ": cosines are for extraordinary places";
    EXPECT_EQ(mask_of(name, options), *ratios) << name;
    const RegularMask<double> floating = regular_mask(*find_scheme<double>(name, options));
    EXPECT_EQ(floating.triangular, exact.triangular) << name;
    EXPECT_EQ(floating.dual, exact.dual) << name;
    EXPECT_EQ(floating.dilation, exact.dilation) << name;
    ASSERT_EQ(floating.weights.size(), exact.weights.size()) << name;
    for (const auto& [key, weight] : ratios->weights)
      EXPECT_NEAR(floating.weights.at(key), weight.value(), testing::rounding(8)) << name;
  };
  for (const Scheme<double>& scheme : all_schemes()) check(scheme.name);
  for (const char* tension : {"0", "1/3", "0.7"})
    for (const char* name : {"butterfly", "kobbelt"}) check(name, {{"tension", tension}});
  for (const char* degree : {"2", "5", "8", "9"}) check("averaging", {{"degree", degree}});
}

TEST(RegularMask, LongNumbersStayExact) {
  Scheme<Algebraic> scheme = *find_scheme<Algebraic>("bilinear");
  const Algebraic w = Algebraic::parse("1234567890123456789013/9876543210987654321098");
  scheme.steps[0].masks.vertex = [w](const Ring<Algebraic>& v) {
    return (Algebraic(1) - w) * v.center() + w * v.neighbor_mean();
  };
  const std::optional<RegularMask<Rational>> mask = rational_mask(regular_mask(scheme));
  ASSERT_TRUE(mask);
  EXPECT_EQ(to_string(mask->weights.at({0, 0})), "8641975320864197532085/9876543210987654321098");
  EXPECT_EQ(to_string(mask->weights.at({2, 0})), "1234567890123456789013/39506172843950617284392");
}

TEST(RegularMask, IrrationalWeightsMakeNoRationalMask) {
  RegularMask<Algebraic> mask = regular_mask(*find_scheme<Algebraic>("loop"));
  EXPECT_EQ(rational_mask(mask)->weights, mask_of("loop").weights);
  mask.weights.at({0, 0}) += Number<Algebraic>::cos_2pi(1, 5);
  EXPECT_FALSE(rational_mask(mask));
}

TEST(RegularMask, ButterflyHasItsWings) {
  const RegularMask<Rational> mask = mask_of("butterfly");
  EXPECT_EQ(mask.weights.size(), 25u);
  EXPECT_EQ(mask.weights.at({0, 0}), Rational(1));
  EXPECT_EQ(mask.weights.at({1, 0}), Rational(1) / 2);
  EXPECT_EQ(mask.weights, mask_of("modified-butterfly").weights);
}

}  // namespace
}  // namespace sublimit
