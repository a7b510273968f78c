// SPDX-License-Identifier: Apache-2.0
#pragma once
// Comparison of the results of a GPU with those of the scalar kernel. Tolerances are multiples of the rounding
// of the sum of the magnitudes of all terms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace sublimit::testing {

inline constexpr double float_rounding = 0x1p-23;

/// Tolerance, in roundings, of sums of hundreds of terms in another order: errors grow as the root of their
/// number.
inline constexpr double roundings_of_another_order = 16;

/// Expects that |x - right| is within `roundings` roundings of a float as large as the sum of the magnitudes of
/// its terms.
inline void expect_near_terms(std::span<const float> x, std::span<const float> right, std::span<const double> terms,
                              double roundings = 2) {
  ASSERT_EQ(x.size(), right.size());
  ASSERT_EQ(x.size(), terms.size());
  for (size_t i = 0; i < x.size(); ++i)
    ASSERT_TRUE(std::abs(double(x[i]) - double(right[i])) <= roundings * float_rounding * terms[i])
        << "number " << i << ": " << x[i] << ", not " << right[i];
}

/// Returns the error bound of each result of a rational evaluation, by propagating the roundings of A and w
/// through the quotient rule.
/// @param columns  A and w of all quantities, as the table computes them
/// @param terms    sums of magnitudes of terms for each number of `columns`
/// @return  quantities x points x (channels - 1); infinity where the weight is below its rounding error
inline std::vector<double> roundings_of_quotients(std::span<const float> columns, std::span<const double> terms,
                                                  int quantities, size_t channels) {
  const size_t points = columns.size() / (size_t(quantities) * channels);
  std::vector<double> all(size_t(quantities) * points * (channels - 1));
  for (size_t i = 0; i < points; ++i)
    for (size_t c = 0; c + 1 < channels; ++c) {
      const auto at = [&](int q, size_t channel) { return (size_t(q) * points + i) * channels + channel; };
      const auto A = [&](int q) { return double(columns[at(q, c)]); };
      const auto w = [&](int q) { return double(columns[at(q, channels - 1)]); };
      const auto noise = [&](int q, double x) {  // of A - w x
        return 4 * float_rounding * (terms[at(q, c)] + std::abs(x) * terms[at(q, channels - 1)]);
      };
      const bool is_pole = std::abs(w(0)) <= 16 * float_rounding * terms[at(0, channels - 1)];
      double x[6] = {}, error[6] = {};
      const auto step = [&](int q, std::initializer_list<std::array<int, 3>> quotient) {
        if (q >= quantities) return;
        double sum = A(q), rounding = noise(q, 0);
        for (const auto& [row, lower, factor] : quotient) {
          sum -= factor * w(row) * x[lower];
          rounding += factor * (noise(row, x[lower]) + std::abs(w(row)) * error[lower]);
        }
        x[q] = sum / w(0);
        error[q] = (rounding + noise(0, x[q])) / std::abs(w(0));
        all[(size_t(q) * points + i) * (channels - 1) + c] =
            is_pole ? std::numeric_limits<double>::infinity() : error[q];
      };
      step(0, {});
      step(1, {{1, 0, 1}});
      step(2, {{2, 0, 1}});
      step(3, {{1, 1, 2}, {3, 0, 1}});
      step(4, {{1, 2, 1}, {2, 1, 1}, {4, 0, 1}});
      step(5, {{2, 2, 2}, {5, 0, 1}});
    }
  return all;
}

/// Expects near unit normals along u x v, with a bound from the roundings of the derivatives and the angle
/// between them.
/// @param derivatives  derivatives along u at all points, then along v
/// @param terms        sums of magnitudes of terms for each number of `derivatives`
/// @return  number of points compared: those whose derivatives exceed their rounding errors
inline size_t expect_near_normals(std::span<const float> x, std::span<const float> right,
                                  std::span<const float> derivatives, std::span<const double> terms) {
  EXPECT_EQ(x.size(), right.size());
  EXPECT_EQ(derivatives.size(), 2 * x.size());
  size_t compared = 0;
  for (size_t i = 0; i < x.size(); i += 3) {
    double size = 0, u2 = 0, v2 = 0, noise = 0;
    for (size_t c = 0; c < 3; ++c) {
      const auto u = [&](size_t k) { return double(derivatives[i + (c + k) % 3]); };
      const auto v = [&](size_t k) { return double(derivatives[x.size() + i + (c + k) % 3]); };
      const double n = u(1) * v(2) - u(2) * v(1);
      size += n * n, u2 += u(0) * u(0), v2 += v(0) * v(0);
      noise = std::max({noise, terms[i + c], terms[x.size() + i + c]});
    }
    const double bound = 8 * float_rounding * noise * (std::sqrt(u2) + std::sqrt(v2)) / std::sqrt(size);
    if (!(bound < 1e-3)) continue;
    ++compared;
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(x[i + c], right[i + c], bound) << "point " << i / 3;
  }
  return compared;
}

/// Returns the value of a half float from its bits.
inline double half_value(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double magnitude = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return bits & 0x8000 ? -magnitude : magnitude;
}

}  // namespace sublimit::testing
