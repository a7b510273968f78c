// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/detail/polynomial.h"

#include <flint/fmpz_poly_factor.h>

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/certificates/numbers/detail/flint_value.h"

namespace sublimit {

Polynomial::Polynomial(std::vector<Algebraic> coefficients) : c_(std::move(coefficients)) { trim(); }

void Polynomial::trim() {
  while (!c_.empty() && c_.back().is_zero()) c_.pop_back();
}

bool Polynomial::is_rational() const {
  return std::all_of(c_.begin(), c_.end(), [](const Algebraic& c) { return c.is_rational(); });
}

bool Polynomial::is_real() const {
  return std::all_of(c_.begin(), c_.end(), [](const Algebraic& c) { return c.is_real(); });
}

Polynomial& Polynomial::operator+=(const Polynomial& b) {
  if (c_.size() < b.c_.size()) c_.resize(b.c_.size());
  for (size_t i = 0; i < b.c_.size(); ++i) c_[i] += b.c_[i];
  trim();
  return *this;
}

Polynomial& Polynomial::operator-=(const Polynomial& b) {
  if (c_.size() < b.c_.size()) c_.resize(b.c_.size());
  for (size_t i = 0; i < b.c_.size(); ++i) c_[i] -= b.c_[i];
  trim();
  return *this;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  if (a.is_zero() || b.is_zero()) return {};
  std::vector<Algebraic> c(a.c_.size() + b.c_.size() - 1);
  for (size_t i = 0; i < a.c_.size(); ++i)
    for (size_t j = 0; j < b.c_.size(); ++j)
      if (!a.c_[i].is_zero() && !b.c_[j].is_zero()) c[i + j] += a.c_[i] * b.c_[j];
  return Polynomial(std::move(c));
}

Polynomial operator*(const Algebraic& factor, const Polynomial& a) {
  std::vector<Algebraic> c = a.c_;
  for (Algebraic& value : c) value *= factor;
  return Polynomial(std::move(c));
}

Algebraic Polynomial::at(const Algebraic& x) const {
  Algebraic sum;
  for (size_t i = c_.size(); i-- > 0;) sum = sum * x + c_[i];
  return sum;
}

ComplexBall Polynomial::at(const ComplexBall& x) const {
  ComplexBall sum;
  for (size_t i = c_.size(); i-- > 0;) sum = sum * x + c_[i].enclosure();
  return sum;
}

Polynomial Polynomial::derivative() const {
  std::vector<Algebraic> c;
  for (size_t i = 1; i < c_.size(); ++i) c.push_back(static_cast<int>(i) * c_[i]);
  return Polynomial(std::move(c));
}

Polynomial Polynomial::monic() const { return is_zero() || leading().is_one() ? *this : leading().inverse() * *this; }

Polynomial Polynomial::conj() const {
  std::vector<Algebraic> c;
  for (const Algebraic& value : c_) c.push_back(value.conj());
  return Polynomial(std::move(c));
}

Polynomial Polynomial::negated() const {
  std::vector<Algebraic> c;
  for (size_t i = 0; i < c_.size(); ++i) c.push_back((c_.size() - 1 - i) % 2 == 0 ? c_[i] : -c_[i]);
  return Polynomial(std::move(c));
}

std::string Polynomial::text() const {
  std::string all;
  for (size_t i = c_.size(); i-- > 0;) {
    if (c_[i].is_zero()) continue;
    const std::string power = i == 0 ? "" : i == 1 ? "x" : "x^" + std::to_string(i);
    std::string factor = c_[i].text();
    if (!c_[i].is_rational() && i > 0) factor = "(" + factor + ")";
    if (i > 0 && c_[i].is_one())
      factor = "";
    else if (i > 0)
      factor += "*";
    if (!all.empty() && factor[0] != '-') all += '+';
    all += factor + power;
  }
  return all.empty() ? "0" : all;
}

std::string Polynomial::exact_text() const {
  std::string all;
  for (const Algebraic& c : c_) all += (all.empty() ? "" : "; ") + c.exact_text();
  return all;
}

Polynomial Polynomial::parse(std::string_view text) {
  std::vector<Algebraic> c;
  for (size_t from = 0; from <= text.size();) {
    const size_t to = std::min(text.find(';', from), text.size());
    c.push_back(Algebraic::parse(text.substr(from, to - from)));
    from = to + 1;
  }
  return Polynomial(std::move(c));
}

Division divide(const Polynomial& a, const Polynomial& b) {
  if (b.is_zero()) throw AnalysisError("division by the zero polynomial");
  std::vector<Algebraic> rest = a.coefficients(), quotient(std::max(0, a.degree() - b.degree() + 1));
  const Algebraic inverse = b.leading().inverse();
  for (int i = a.degree() - b.degree(); i >= 0; --i) {
    quotient[i] = rest[i + b.degree()] * inverse;
    if (quotient[i].is_zero()) continue;
    for (int j = 0; j <= b.degree(); ++j) rest[i + j] -= quotient[i] * b.coefficients()[j];
  }
  return {Polynomial(std::move(quotient)), Polynomial(std::move(rest))};
}

Polynomial gcd(Polynomial a, Polynomial b) {
  while (!b.is_zero()) {
    Polynomial rest = divide(a, b).remainder.monic();
    a = std::exchange(b, std::move(rest));
  }
  return a.monic();
}

namespace {

/// Irreducible factors over the rationals.
std::vector<PolynomialFactor> rational_factors(const Polynomial& p) {
  RationalPolynomial q;
  IntegerPolynomial numerator;
  FlintValue<fmpz_poly_factor_struct, fmpz_poly_factor_init, fmpz_poly_factor_clear> factors;
  FlintRatio c;
  for (int i = 0; i <= p.degree(); ++i) {
    fmpq_poly_get_coeff_fmpq(c, p.coefficients()[i].polynomial(), 0);
    fmpq_poly_set_coeff_fmpq(q, i, c);
  }
  fmpq_poly_get_numerator(numerator, q);
  fmpz_poly_factor(factors, numerator);
  std::vector<PolynomialFactor> result;
  for (long f = 0; f < factors->num; ++f) {
    std::vector<Algebraic> coefficients;
    for (long i = 0; i < fmpz_poly_length(factors->p + f); ++i) {
      fmpq_set_fmpz(c, (factors->p + f)->coeffs + i);
      coefficients.emplace_back(c);
    }
    result.push_back({Polynomial(std::move(coefficients)).monic(), static_cast<int>(factors->exp[f])});
  }
  return result;
}

}  // namespace

std::vector<PolynomialFactor> squarefree_factors(const Polynomial& p) {
  if (p.degree() < 1) return {};
  if (p.is_rational()) return rational_factors(p);
  // As many roots as the degree says, enclosed apart: coefficients grow less in balls than in common factors.
  if (has_isolated_roots(p)) return {{p.monic(), 1}};
  // Yun's algorithm.
  std::vector<PolynomialFactor> factors;
  const Polynomial slope = p.derivative();
  const Polynomial common = gcd(p, slope);
  Polynomial b = divide(p, common).quotient, c = divide(slope, common).quotient;
  for (int multiplicity = 1; b.degree() > 0; ++multiplicity) {
    const Polynomial d = c - b.derivative();
    Polynomial factor = gcd(b, d);
    b = divide(b, factor).quotient;
    c = divide(d, factor).quotient;
    if (factor.degree() > 0) factors.push_back({std::move(factor), multiplicity});
  }
  return factors;
}

}  // namespace sublimit
