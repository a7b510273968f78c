// SPDX-License-Identifier: Apache-2.0
#pragma once
// Intervals of doubles that certainly hold the value: every operation rounds outwards, except where the result is exact
// (sums and products of short dyadic numbers are), which an error-free transformation tells. Enough for norms of
// masks; no library is needed.
#include <algorithm>
#include <cmath>
#include <limits>

namespace sublimit {

struct Interval {
  double low = 0, high = 0;

  Interval() = default;
  Interval(double value) : low(value), high(value) {}  // NOLINT: numbers are intervals
  Interval(double from, double to) : low(from), high(to) {}

  bool is_exact() const { return low == high; }
  double middle() const { return low == high ? low : low / 2 + high / 2; }

  friend Interval operator+(const Interval& a, const Interval& b) {
    return {sum(a.low, b.low, -1), sum(a.high, b.high, 1)};
  }
  friend Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
  friend Interval operator-(const Interval& a, const Interval& b) { return a + -b; }
  friend Interval operator*(const Interval& a, const Interval& b) {
    const double ends[] = {a.low, a.high}, others[] = {b.low, b.high};
    Interval r(infinity, -infinity);
    for (const double x : ends)
      for (const double y : others) {
        r.low = std::min(r.low, product(x, y, -1));
        r.high = std::max(r.high, product(x, y, 1));
      }
    return r;
  }
  Interval& operator+=(const Interval& b) { return *this = *this + b; }
  Interval& operator*=(const Interval& b) { return *this = *this * b; }
  friend Interval abs(const Interval& a) {
    if (a.low >= 0) return a;
    if (a.high <= 0) return -a;
    return {0, std::max(-a.low, a.high)};
  }
  friend Interval max(const Interval& a, const Interval& b) {
    return {std::max(a.low, b.low), std::max(a.high, b.high)};
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  /// Below this a product's rounding error may be too small to be seen.
  static constexpr double tiny = 0x1p-900;

  static double outwards(double x, int side) { return std::nextafter(x, side * infinity); }
  static double sum(double a, double b, int side) {
    const double s = a + b, rest = s - a;
    const double error = (a - (s - rest)) + (b - rest);  // Knuth's two-sum; NaN and infinities round outwards too
    return error == 0 ? s : outwards(s, side);
  }
  static double product(double a, double b, int side) {
    const double p = a * b;
    if (a == 0 || b == 0) return 0;
    return std::abs(p) > tiny && std::fma(a, b, -p) == 0 ? p : outwards(p, side);
  }
};

/// p/q rounded outwards, q > 0.
inline Interval quotient(double p, double q) {
  const double x = p / q;
  if (std::fma(x, q, -p) == 0 && (p == 0 || std::abs(x) > 0x1p-900)) return x;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {std::nextafter(x, -infinity), std::nextafter(x, infinity)};
}

/// Binary logarithm; exact at powers of two. The library's is taken to be right within two units in the last place.
inline Interval log2(const Interval& a) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto of = [](double x, int side) {
    int exponent = 0;
    if (x > 0 && std::frexp(x, &exponent) == 0.5) return double(exponent - 1);
    double y = std::log2(x);
    for (int i = 0; i < 4 && std::isfinite(y); ++i) y = std::nextafter(y, side * infinity);
    return y;
  };
  return {a.low <= 0 ? -infinity : of(a.low, -1), a.high <= 0 ? -infinity : of(a.high, 1)};
}

}  // namespace sublimit
