// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/algebraic.h"

#include <arb_fmpz_poly.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/base/error.h"
#include "sublimit/certificates/numbers/detail/flint_value.h"

namespace sublimit {
namespace {

/// The minimal polynomial of zeta_N, computed once and valid until the program ends.
const fmpq_poly_struct* minimal_polynomial(long order) {
  static const FoundByKey<long, std::unique_ptr<const RationalPolynomial>> all;
  return *all.get(order, [&] {
    auto found = std::make_unique<RationalPolynomial>();
    IntegerPolynomial phi;
    fmpz_poly_cyclotomic(phi, static_cast<ulong>(order));
    fmpq_poly_set_fmpz_poly(*found, phi);
    return found;
  });
}

/// Sets q to the sum of p_i x^to(i).
template <class To>
void move_powers(fmpq_poly_t q, const fmpq_poly_struct* p, To to) {
  FlintRatio c;
  for (long i = fmpq_poly_length(p); i-- > 0;) {
    fmpq_poly_get_coeff_fmpq(c, p, i);
    fmpq_poly_set_coeff_fmpq(q, to(i), c);
  }
}

long positive_remainder(long k, long n) { return (k % n + n) % n; }

}  // namespace

Algebraic::Algebraic(double value) : Algebraic() {
  if (!std::isfinite(value)) throw AnalysisError("infinity and NaN are no algebraic numbers");
  FlintRatio q;
  arf_get_fmpq(q, arb_midref(Ball(value).get()));
  fmpq_poly_set_fmpq(p_, q);
}

Algebraic Algebraic::ratio(long p, long q) {
  if (q == 0) throw AnalysisError("division by zero: " + std::to_string(p) + "/0");
  Algebraic r(p);
  fmpq_poly_scalar_div_si(r.p_, r.p_, q);
  return r;
}

Algebraic Algebraic::root_of_unity(long k, long n) {
  k = positive_remainder(k, n);
  const long common = std::gcd(k, n);
  k /= common;
  n /= common;
  bool negative = false;
  if (n % 4 == 2) {  // zeta_2m = -zeta_m^((m + 1)/2), m odd
    n /= 2;
    negative = k % 2 != 0;
    k = k * ((n + 1) / 2) % n;
  }
  Algebraic r;
  fmpq_poly_set_coeff_si(r.p_, k, negative ? -1 : 1);
  r.order_ = n;
  r.reduce();
  return r;
}

void Algebraic::reduce() {
  if (order_ > 1)
    if (const fmpq_poly_struct* m = minimal_polynomial(order_); fmpq_poly_length(p_) >= fmpq_poly_length(m))
      fmpq_poly_rem(p_, p_, m);
  if (is_rational()) order_ = 1;
}

void Algebraic::lift(long order) {
  if (order == order_) return;
  Algebraic r;
  move_powers(r.p_, p_, [&](long i) { return i * (order / order_); });
  if (!is_rational()) fmpq_poly_rem(r.p_, r.p_, minimal_polynomial(order));
  r.order_ = order;
  swap(r);
}

std::pair<Algebraic, Algebraic> in_one_field(const Algebraic& a, const Algebraic& b) {
  std::pair<Algebraic, Algebraic> both(a, b);
  const long order = std::lcm(a.order_, b.order_);
  both.first.lift(order);
  both.second.lift(order);
  return both;
}

Algebraic& Algebraic::operator+=(const Algebraic& b) {
  if (order_ != b.order_ && !is_rational() && !b.is_rational()) {
    auto [x, y] = in_one_field(*this, b);
    return *this = std::move(x += y);
  }
  fmpq_poly_add(p_, p_, b.p_);
  order_ = is_rational() ? 1 : std::max(order_, b.order_);
  return *this;
}

Algebraic& Algebraic::operator-=(const Algebraic& b) { return *this += -b; }

Algebraic& Algebraic::operator*=(const Algebraic& b) {
  if (order_ != b.order_ && !is_rational() && !b.is_rational()) {
    auto [x, y] = in_one_field(*this, b);
    return *this = std::move(x *= y);
  }
  order_ = std::max(order_, b.order_);
  fmpq_poly_mul(p_, p_, b.p_);
  reduce();
  return *this;
}

bool operator==(const Algebraic& a, const Algebraic& b) {
  if (a.order_ == b.order_) return fmpq_poly_equal(a.p_, b.p_);
  if (a.is_rational() || b.is_rational()) return false;
  const auto [x, y] = in_one_field(a, b);
  return fmpq_poly_equal(x.p_, y.p_);
}

Algebraic Algebraic::galois(long a) const {
  if (is_rational()) return *this;
  Algebraic r;
  move_powers(r.p_, p_, [&](long i) { return positive_remainder(a * i, order_); });
  r.order_ = order_;
  r.reduce();
  return r;
}

Algebraic Algebraic::inverse() const {
  if (is_zero()) throw AnalysisError("division by zero among algebraic numbers");
  Algebraic r;
  if (is_rational()) {
    fmpq_poly_inv(r.p_, p_);
    return r;
  }
  RationalPolynomial common, other;  // the gcd is 1: the minimal polynomial is irreducible
  fmpq_poly_xgcd(common, r.p_, other, p_, minimal_polynomial(order_));
  r.order_ = order_;
  return r;
}

ComplexBall Algebraic::enclosure() const {
  const long bits = PrecisionScope::bits();
  IntegerPolynomial numerator;
  fmpq_poly_get_numerator(numerator, p_);
  ComplexBall r;
  if (is_rational()) {
    if (!is_zero()) acb_set_fmpz(r.get(), numerator->coeffs);
  } else {
    const PrecisionScope more(bits + 2 * FLINT_BIT_COUNT(static_cast<ulong>(order_)) +
                              std::abs(fmpz_poly_max_bits(numerator)));
    const ComplexBall zeta = ComplexBall::root_of_unity(1, order_);
    arb_fmpz_poly_evaluate_acb(r.get(), numerator, zeta.get(), PrecisionScope::bits());
  }
  acb_div_fmpz(r.get(), r.get(), fmpq_poly_denref(p_), bits);
  return r;
}

Ball Algebraic::real_enclosure() const {
  if (!is_real()) throw AnalysisError(text() + " is not real");
  return enclosure().re();
}

}  // namespace sublimit
