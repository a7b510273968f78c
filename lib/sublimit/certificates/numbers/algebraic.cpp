// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/algebraic.h"

#include <arb_fmpz_poly.h>

#include <cmath>
#include <numeric>

#include "sublimit/base/error.h"
#include "sublimit/certificates/numbers/detail/cyclotomic.h"

namespace sublimit {
namespace {

/// The numerator of a polynomial over the rationals, as FLINT's functions for integers take it.
struct Numerator {
  fmpz_poly_t p;
  explicit Numerator(const fmpq_poly_struct* q) {
    fmpz_poly_init(p);
    fmpq_poly_get_numerator(p, q);
  }
  ~Numerator() { fmpz_poly_clear(p); }
};

/// p(zeta) over an integer, with the numerator replaced.
void set_numerator(fmpq_poly_t q, const fmpz_poly_t numerator) {
  fmpz_t denominator;
  fmpz_init_set(denominator, fmpq_poly_denref(q));
  fmpq_poly_set_fmpz_poly(q, numerator);
  fmpq_poly_scalar_div_fmpz(q, q, denominator);
  fmpz_clear(denominator);
}

long positive_remainder(long k, long n) { return (k % n + n) % n; }

}  // namespace

Algebraic::Algebraic(double value) : Algebraic() {
  if (!std::isfinite(value)) throw AnalysisError("infinity and NaN are no algebraic numbers");
  fmpq_t q;
  fmpq_init(q);
  arf_get_fmpq(q, arb_midref(Ball(value).get()));
  fmpq_poly_set_fmpq(p_, q);
  fmpq_clear(q);
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
  if (order_ > 1 && fmpq_poly_length(p_) >= fmpz_poly_length(cyclotomic_polynomial(order_))) {
    Numerator numerator(p_);
    reduce_cyclotomic(numerator.p, order_);
    set_numerator(p_, numerator.p);
  }
  if (is_rational()) order_ = 1;
}

void Algebraic::lift(long order) {
  if (order == order_) return;
  if (!is_rational()) {
    Numerator numerator(p_);
    fmpz_poly_inflate(numerator.p, numerator.p, static_cast<ulong>(order / order_));
    reduce_cyclotomic(numerator.p, order);
    set_numerator(p_, numerator.p);
  }
  order_ = order;
}

std::pair<Algebraic, Algebraic> in_one_field(const Algebraic& a, const Algebraic& b) {
  std::pair<Algebraic, Algebraic> both(a, b);
  const long order = std::lcm(a.order_, b.order_);
  both.first.lift(order);
  both.second.lift(order);
  return both;
}

Algebraic& Algebraic::operator+=(const Algebraic& b) {
  if (order_ == b.order_ || b.is_rational()) {
    fmpq_poly_add(p_, p_, b.p_);
  } else if (is_rational()) {
    fmpq_poly_add(p_, p_, b.p_);
    order_ = b.order_;
  } else {
    auto [x, y] = in_one_field(*this, b);
    fmpq_poly_add(x.p_, x.p_, y.p_);
    swap(x);
  }
  if (is_rational()) order_ = 1;
  return *this;
}

Algebraic& Algebraic::operator-=(const Algebraic& b) { return *this += -b; }

Algebraic& Algebraic::operator*=(const Algebraic& b) {
  if (order_ == b.order_ || b.is_rational() || is_rational()) {
    order_ = std::max(order_, b.order_);
    fmpq_poly_mul(p_, p_, b.p_);
    reduce();
  } else {
    auto [x, y] = in_one_field(*this, b);
    fmpq_poly_mul(x.p_, x.p_, y.p_);
    x.reduce();
    swap(x);
  }
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
  const Numerator numerator(p_);
  fmpz_poly_t image;
  fmpz_poly_init2(image, order_);
  const long length = fmpz_poly_length(numerator.p);
  for (long i = 0; i < length; ++i)
    fmpz_poly_set_coeff_fmpz(image, positive_remainder(a * i, order_), numerator.p->coeffs + i);
  reduce_cyclotomic(image, order_);
  Algebraic r(*this);
  set_numerator(r.p_, image);
  fmpz_poly_clear(image);
  return r;
}

Algebraic Algebraic::inverse() const {
  if (is_zero()) throw AnalysisError("division by zero among algebraic numbers");
  Algebraic r;
  if (is_rational()) {
    fmpq_t q;
    fmpq_init(q);
    fmpq_poly_get_coeff_fmpq(q, p_, 0);
    fmpq_inv(q, q);
    fmpq_poly_set_fmpq(r.p_, q);
    fmpq_clear(q);
    return r;
  }
  fmpq_poly_t modulus, common, other;
  fmpq_poly_init(modulus);
  fmpq_poly_init(common);
  fmpq_poly_init(other);
  fmpq_poly_set_fmpz_poly(modulus, cyclotomic_polynomial(order_));
  fmpq_poly_xgcd(common, r.p_, other, p_, modulus);  // the gcd is 1: the modulus is irreducible
  fmpq_poly_clear(modulus);
  fmpq_poly_clear(common);
  fmpq_poly_clear(other);
  r.order_ = order_;
  return r;
}

ComplexBall Algebraic::enclosure() const {
  const long bits = PrecisionScope::bits();
  const Numerator numerator(p_);
  ComplexBall r;
  if (is_rational()) {
    if (!is_zero()) acb_set_fmpz(r.get(), numerator.p->coeffs);
  } else {
    const PrecisionScope more(bits + 2 * FLINT_BIT_COUNT(static_cast<ulong>(order_)) +
                              std::abs(fmpz_poly_max_bits(numerator.p)));
    const ComplexBall zeta = ComplexBall::root_of_unity(1, order_);
    arb_fmpz_poly_evaluate_acb(r.get(), numerator.p, zeta.get(), PrecisionScope::bits());
  }
  acb_div_fmpz(r.get(), r.get(), fmpq_poly_denref(p_), bits);
  return r;
}

Ball Algebraic::real_enclosure() const {
  if (!is_real()) throw AnalysisError(text() + " is not real");
  return enclosure().re();
}

}  // namespace sublimit
