// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/detail/rational_number.h"

#include <cmath>
#include <memory>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {

Rational::Rational(long p, long q) : Rational() {
  if (q == 0) throw AnalysisError("division of a ratio by zero");
  fmpz_set_si(fmpq_numref(x_), p);
  fmpz_set_si(fmpq_denref(x_), q);
  fmpq_canonicalise(x_);
}

Rational::Rational(double value) : Rational() {
  if (!std::isfinite(value))
    throw InvalidMesh("a coordinate is " + format_number(value) +
                      ", which is no ratio: finite ones, so small that their sums and products are finite, are right");
  arf_get_fmpq(x_, arb_midref(Ball(value).get()));
}

Ball Rational::enclosure() const {
  Ball r;
  if (is_ratio_)
    arb_set_fmpq(r.get(), x_, PrecisionScope::bits());
  else
    arb_zero_pm_inf(r.get());
  return r;
}

Rational& Rational::operator/=(const Rational& b) {
  if (b.is_zero()) throw AnalysisError("division of a ratio by zero");
  if (b.is_ratio_) fmpq_div(x_, x_, b.x_);
  return with(b);
}

Rational sqrt(const Rational& a) {
  if (!a.is_ratio_ || !fmpz_is_square(fmpq_numref(a.x_)) || !fmpz_is_square(fmpq_denref(a.x_)))
    return Rational::irrational();
  Rational root;
  fmpz_sqrt(fmpq_numref(root.x_), fmpq_numref(a.x_));
  fmpz_sqrt(fmpq_denref(root.x_), fmpq_denref(a.x_));
  return root;
}

std::string to_string(const Rational& r) {
  if (!r.is_ratio()) return "irrational";
  const std::unique_ptr<char, decltype(&flint_free)> text(fmpq_get_str(nullptr, 10, r.get()), flint_free);
  return text.get();
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
