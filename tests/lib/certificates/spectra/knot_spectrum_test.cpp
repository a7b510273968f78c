// SPDX-License-Identifier: Apache-2.0
// Spectra between unequal knot intervals: known ones of equal intervals, tensor products, and tables made elsewhere.
#include "sublimit/certificates/spectra/knot_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

const Scheme<double> halving = *find_scheme("catmull-clark-intervals", {{"levelling", "off"}});

std::vector<double> moduli(const std::vector<double>& intervals) {
  std::vector<double> result;
  for (const auto& value : knot_spectrum(halving, intervals)) result.push_back(std::abs(value));
  return result;
}

/// Catmull and Clark's own: lambda = (c + 5 + sqrt((c + 9) (c + 1))) / 16, c = cos(2 pi / n), twice.
TEST(KnotSpectrum, OfEqualIntervalsIsCatmullClarks) {
  for (const int n : {3, 4, 5, 6, 8}) {
    const std::vector<double> equal(size_t(n), 2.5);
    const double c = std::cos(2 * std::numbers::pi / n), lambda = (c + 5 + std::sqrt((c + 9) * (c + 1))) / 16;
    const auto values = knot_spectrum(halving, equal);
    EXPECT_NEAR(std::abs(values[0]), 1, other_route);
    EXPECT_NEAR(std::abs(values[1]), lambda, other_route);
    EXPECT_NEAR(std::abs(values[2]), lambda, other_route);
  }
}

TEST(KnotSpectrum, OfTensorProductsIsThatOfKnotInsertion) {
  const std::vector<double> own = moduli({1, 5, 1, 5});
  const double expected[] = {1, 0.5, 0.5, 0.25, 0.25, 0.25};
  constexpr double half_the_digits = 1e-7;  // of eigenvalues in Jordan's blocks
  for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(own[i], expected[i], half_the_digits) << i;
}

/// Moduli computed for the same rules by another program, to five digits, the last one rounded or cut off.
constexpr double five_digits = 1e-5;
TEST(KnotSpectrum, OfUnequalIntervalsAreThoseOfTheTable) {
  const std::pair<std::vector<double>, std::array<double, 3>> table[] = {
      {{1, 1, 4}, {.41121, .38979, .22595}},          {{1, 1, 16}, {.45948, .43943, .24661}},
      {{1, 1, 1, 1, 4}, {.64653, .53608, .38377}},    {{1, 1, 1, 1, 16}, {.74765, .61895, .47735}},
      {{1, 4, 1, 4, 1}, {.67152, .47695, .35530}},    {{1, 8, 1, 8, 1, 8}, {.57968, .57968, .41010}},
      {{1, 1, 1, 8, 8, 8}, {.72904, .70359, .42991}},
  };
  for (const auto& [intervals, expected] : table) {
    const std::vector<double> own = moduli(intervals);
    for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(own[i + 1], expected[i], five_digits) << intervals.size() << ' ' << i;
  }
}

/// patches.md 10.3; of equal ones Doo-Sabin's by averaging: 1/2 + cos(2 pi / n) / 4 (3/8 of a triangle).
TEST(KnotSpectrum, OfFacesMaySpiral) {
  const Scheme<double> points = *find_scheme("doo-sabin-intervals", {{"levelling", "off"}});
  const auto expect_pair = [&](const std::vector<double>& intervals, std::complex<double> expected, double allowed) {
    const auto values = knot_spectrum(points, intervals);
    EXPECT_NEAR(values[0].real(), 1, rounding(12));
    for (const size_t i : {1, 2}) {
      EXPECT_NEAR(values[i].real(), expected.real(), allowed);
      EXPECT_NEAR(std::abs(values[i].imag()), expected.imag(), allowed);
    }
  };
  expect_pair({1, 1, 1}, 0.375, rounding(1e6));
  expect_pair({1, 1, 1, 1, 1}, (2 + std::cos(2 * std::numbers::pi / 5)) / 4, rounding(1e6));
  constexpr double four_digits = 1e-4;
  expect_pair({1, 2, 4}, {0.375, 0.0559}, four_digits);
  expect_pair({1, 8, 1, 8, 1, 8}, {0.6446, 0.0728}, four_digits);
}

TEST(KnotSpectrum, RefusesWhatDoesNotStay) {
  const double good[] = {1, 2, 3}, bad[] = {1, 0, 3}, two[] = {1, 2};
  expect_error<InvalidParameter>([&] { knot_spectrum(*find_scheme("catmull-clark-intervals"), good); },
                                 {"in the middle"});
  expect_error<InvalidParameter>([&] { knot_spectrum(halving, bad); }, {"interval 0", "positive"});
  expect_error<InvalidParameter>([&] { knot_spectrum(halving, two); }, {"three spokes"});
}

}  // namespace
}  // namespace sublimit::testing
