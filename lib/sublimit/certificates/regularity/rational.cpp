// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/rational.h"

#include <cmath>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Integer = Rational::Integer;

[[noreturn]] void overflow() { throw AnalysisError("a ratio needs more than 128 bits; give masks with fewer digits"); }
Integer times(Integer a, Integer b) {
  Integer r = 0;
  if (__builtin_mul_overflow(a, b, &r)) overflow();
  return r;
}
Integer plus(Integer a, Integer b) {
  Integer r = 0;
  if (__builtin_add_overflow(a, b, &r)) overflow();
  return r;
}
Integer gcd(Integer a, Integer b) {
  if (a < 0) a = -a;
  while (b != 0) {
    const Integer rest = a % b;
    a = b;
    b = rest < 0 ? -rest : rest;
  }
  return a;
}
Interval enclosure_of(Integer value) {
  const double d = static_cast<double>(value);
  if (std::abs(d) < 0x1p126 && static_cast<Integer>(d) == value) return d;
  return {std::nextafter(d, -INFINITY), std::nextafter(d, INFINITY)};
}
Integer integer(const fmpz_t value) {
  if (fmpz_bits(value) > 120) overflow();
  fmpz_t high, low;
  fmpz_init(high);
  fmpz_init(low);
  fmpz_fdiv_q_2exp(high, value, 60);
  fmpz_fdiv_r_2exp(low, value, 60);
  const Integer result = Integer{fmpz_get_si(high)} * (Integer{1} << 60) + fmpz_get_si(low);
  fmpz_clear(high);
  fmpz_clear(low);
  return result;
}
std::string digits(Integer value) {
  if (value < 0) return "-" + digits(-value);
  std::string text;
  do text.insert(text.begin(), static_cast<char>('0' + static_cast<int>(value % 10)));
  while ((value /= 10) != 0);
  return text;
}
Integer root(Integer value) {
  Integer x = static_cast<Integer>(std::sqrt(static_cast<double>(value)));
  while (x > 0 && x > value / x) --x;
  while (x + 1 <= value / (x + 1)) ++x;
  return x;
}

}  // namespace

Rational::Rational(Integer p, Integer q) : p_(p), q_(q) {
  if (q == 0) throw AnalysisError("division of a ratio by zero");
  const Integer common = gcd(p_, q_);
  p_ /= q_ < 0 ? -common : common;
  q_ /= q_ < 0 ? -common : common;
}

Rational::Rational(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  if (!std::isfinite(value)) throw AnalysisError("a number is not finite");
  p_ = static_cast<Integer>(std::ldexp(mantissa, 53));
  for (exponent -= 53; exponent < 0 && p_ % 2 == 0 && p_ != 0; ++exponent) p_ /= 2;
  if (p_ == 0) return;
  if (exponent < -120 || exponent > 60) overflow();
  (exponent < 0 ? q_ : p_) *= Integer{1} << std::abs(exponent);
}

Rational::Rational(const fmpq_t value) : p_(integer(fmpq_numref(value))), q_(integer(fmpq_denref(value))) {}

Interval Rational::enclosure() const {
  if (!is_ratio()) return {-INFINITY, INFINITY};
  const Interval p = enclosure_of(p_), q = enclosure_of(q_);
  const Interval a = quotient(p.low, p.low < 0 ? q.low : q.high), b = quotient(p.high, p.high < 0 ? q.high : q.low);
  return {a.low, b.high};
}

Rational operator+(const Rational& a, const Rational& b) {
  if (!a.is_ratio() || !b.is_ratio()) return Rational::irrational();
  const Integer common = gcd(a.q_, b.q_);
  return {plus(times(a.p_, b.q_ / common), times(b.p_, a.q_ / common)), times(a.q_, b.q_ / common)};
}

Rational operator*(const Rational& a, const Rational& b) {
  if (!a.is_ratio() || !b.is_ratio()) return Rational::irrational();
  const Integer one = gcd(a.p_, b.q_), other = gcd(b.p_, a.q_);  // crosswise first: smaller numbers
  if (a.p_ == 0 || b.p_ == 0) return 0;
  return {times(a.p_ / one, b.p_ / other), times(a.q_ / other, b.q_ / one)};
}

Rational operator/(const Rational& a, const Rational& b) {
  return a.is_ratio() && b.is_ratio() ? a * Rational(b.q_, b.p_) : Rational::irrational();
}

Rational sqrt(const Rational& a) {
  if (a.p_ >= 0 && a.is_ratio()) {
    const Integer p = root(a.p_), q = root(a.q_);
    if (p * p == a.p_ && q * q == a.q_) return {p, q};
  }
  return Rational::irrational();
}

std::string to_string(const Rational& r) {
  if (!r.is_ratio()) return "irrational";
  return digits(r.numerator()) + (r.denominator() == 1 ? "" : "/" + digits(r.denominator()));
}

Rational Number<Rational>::cos_2pi(int k, int n) {
  k = k % n < 0 ? k % n + n : k % n;
  if (2 * k > n) k = n - k;
  for (int i = 0; i <= 4; ++i) {  // of 0, 60, 90, 120, 180 degrees
    constexpr int twelfths[] = {0, 2, 3, 4, 6}, halves[] = {2, 1, 0, -1, -2};
    if (12 * k == twelfths[i] * n) return ratio(halves[i], 2);
  }
  return Rational::irrational();
}

}  // namespace sublimit
