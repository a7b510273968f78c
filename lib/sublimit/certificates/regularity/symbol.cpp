// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/symbol.h"

#include <algorithm>
#include <numeric>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

// Polynomials over the integers modulo the prime 2^61 - 1, ascending powers. What has no common divisor there has none
// over the ratios, as long as leading coefficients do not vanish; coefficients stay small.
using Integer = Rational::Integer;
constexpr Integer prime = (Integer{1} << 61) - 1;
using IntegerPolynomial = std::vector<Integer>;

Integer reduced(Integer x) { return x % prime < 0 ? x % prime + prime : x % prime; }

Integer inverse(Integer x) {  // x^(prime - 2)
  Integer result = 1;
  for (Integer power = prime - 2; power > 0; power /= 2, x = x * x % prime)
    if (power % 2 != 0) result = result * x % prime;
  return result;
}

void trim(IntegerPolynomial& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

IntegerPolynomial remainder(IntegerPolynomial p, const IntegerPolynomial& divisor) {
  const Integer lead = inverse(divisor.back());
  for (trim(p); p.size() >= divisor.size(); trim(p)) {
    const Integer factor = p.back() * lead % prime;
    const size_t shift = p.size() - divisor.size();
    for (size_t i = 0; i < divisor.size(); ++i) p[shift + i] = reduced(p[shift + i] - factor * divisor[i]);
  }
  return p;
}

IntegerPolynomial common_divisor(IntegerPolynomial p, IntegerPolynomial q) {
  while (!q.empty()) {
    IntegerPolynomial rest = remainder(std::move(p), q);
    p = std::move(q);
    q = std::move(rest);
  }
  return p;
}

/// The cyclotomic polynomial of order n: z^n - 1 over those of the proper divisors.
IntegerPolynomial cyclotomic(int n) {
  IntegerPolynomial p(n + 1);
  p[0] = prime - 1;
  p[n] = 1;
  for (int d = 1; d < n; ++d) {
    if (n % d != 0) continue;
    const IntegerPolynomial divisor = cyclotomic(d);
    IntegerPolynomial quotient(p.size() - divisor.size() + 1);
    for (size_t i = quotient.size(); i-- > 0;) {
      quotient[i] = p[i + divisor.size() - 1];
      for (size_t j = 0; j < divisor.size(); ++j) p[i + j] = reduced(p[i + j] - quotient[i] * divisor[j]);
    }
    p = std::move(quotient);
  }
  return p;
}

/// A ratio modulo the prime; nothing if its denominator vanishes there.
std::optional<Integer> modular(const Rational& r) {
  if (r.denominator() % prime == 0) return std::nullopt;
  return reduced(r.numerator()) * inverse(reduced(r.denominator())) % prime;
}

}  // namespace

Symbol trimmed(Symbol a) {
  auto& c = a.coefficients;
  while (!c.empty() && c.back().is_zero()) c.pop_back();
  while (!c.empty() && c.front().is_zero()) c.erase(c.begin()), ++a.first;
  return a;
}

Symbol symbol(const CurveScheme<Rational>& scheme, int level) {
  if (scheme.masks.unknowns() > 1)
    throw AnalysisError(scheme.name +
                        " has derivatives among its unknowns: its symbol is a matrix, which is not analysed");
  const CurveSite<Rational> site(level);
  Symbol a;
  a.shift = scheme.masks.dual() ? Number<Rational>::ratio(1, 2) : Rational(0);
  std::vector<std::pair<int, Rational>> terms;
  for (const int which : {0, 1}) {
    const Stencil<Rational> mask = scheme.masks.child(which)(site);
    for (const auto& [slot, weight] : mask.terms()) terms.emplace_back(which - 2 * slot, weight);
  }
  std::sort(terms.begin(), terms.end(), [](const auto& s, const auto& t) { return s.first < t.first; });
  a.first = terms.front().first;
  a.coefficients.resize(terms.back().first - a.first + 1);
  for (const auto& [power, weight] : terms) {
    if (!weight.is_ratio()) throw AnalysisError(scheme.name + ": a weight is irrational");
    a.coefficients[power - a.first] = weight;
  }
  return trimmed(std::move(a));
}

std::optional<Symbol> over_one_plus_z(const Symbol& a) {
  if (a.coefficients.empty()) return std::nullopt;
  Symbol b = a;
  b.coefficients.pop_back();
  Rational carried = 0;
  for (Rational& c : b.coefficients) c = carried = c - carried;
  if (carried != a.coefficients.back()) return std::nullopt;
  return trimmed(std::move(b));
}

int smoothing_factors(const Symbol& a) {
  int count = 0;
  for (std::optional<Symbol> b = over_one_plus_z(a); b; b = over_one_plus_z(*b)) ++count;
  return count;
}

Symbol difference_symbol(Symbol a, int m) {
  for (int i = 0; i < m; ++i) {
    std::optional<Symbol> b = over_one_plus_z(a);
    if (!b) throw AnalysisError("(1+z)^" + std::to_string(m) + " does not divide the symbol");
    a = std::move(*b);
  }
  return a;
}

bool has_independent_shifts(const Symbol& a) {
  const Symbol t = trimmed(a);
  IntegerPolynomial all, parity[2];  // a(z) = even(z^2) + z odd(z^2): zeros common to a(z) and a(-z) are common to both
  for (size_t i = 0; i < t.coefficients.size(); ++i) {
    const std::optional<Integer> c = modular(t.coefficients[i]);
    if (!c || (i + 1 == t.coefficients.size() && *c == 0)) return false;
    all.push_back(*c);
    parity[i % 2].push_back(*c);
  }
  for (IntegerPolynomial& p : parity) {
    const size_t size = p.size();
    trim(p);
    if (p.empty()) return false;
    // A leading coefficient that vanished modulo the prime only would hide a divisor.
    const size_t index = 2 * (p.size() - 1) + (&p == &parity[1] ? 1 : 0);
    for (size_t i = index + 2; i < 2 * size; i += 2)
      if (i < t.coefficients.size() && !t.coefficients[i].is_zero()) return false;
  }
  if (common_divisor(parity[0], parity[1]).size() > 1) return false;
  const int degree = static_cast<int>(all.size()) - 1;
  for (int m = 3; m <= 2 * degree * degree + 1; m += 2) {  // the number of units modulo m is at least sqrt(m/2)
    int units = 0;
    for (int k = 1; k < m; ++k) units += std::gcd(k, m) == 1;
    if (units <= degree && remainder(all, cyclotomic(2 * m)).empty()) return false;
  }
  return true;
}

Rational value_at_one(const Symbol& a, int sign) {
  Rational sum = 0;
  for (int k = a.first; k <= a.last(); ++k) sum += k % 2 != 0 && sign < 0 ? -a.at(k) : a.at(k);
  return sum;
}

}  // namespace sublimit
