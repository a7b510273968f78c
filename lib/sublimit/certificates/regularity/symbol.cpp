// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/symbol.h"

#include <flint/ulong_extras.h>

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/certificates/numbers/detail/polynomial.h"

namespace sublimit {

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
  // a(z) = even(z^2) + z odd(z^2): zeros common to a(z) and a(-z) are common to both. None is 0, a being trimmed.
  std::vector<Algebraic> all, parity[2];
  for (const Rational& c : trimmed(a).coefficients) {
    parity[all.size() % 2].emplace_back(c.get());
    all.emplace_back(c.get());
  }
  const Polynomial even(parity[0]), odd(parity[1]), p(all);
  if (even.is_zero() || odd.is_zero() || gcd(even, odd).degree() > 0) return false;
  const long degree = p.degree();
  for (long m = 3; m <= 2 * degree * degree + 1; m += 2)  // the number of units modulo m is at least sqrt(m/2)
    if (static_cast<long>(n_euler_phi(static_cast<ulong>(m))) <= degree &&
        p.at(Algebraic::root_of_unity(1, 2 * m)).is_zero())
      return false;
  return true;
}

Rational value_at_one(const Symbol& a, int sign) {
  Rational sum = 0;
  for (int k = a.first; k <= a.last(); ++k) sum += k % 2 != 0 && sign < 0 ? -a.at(k) : a.at(k);
  return sum;
}

}  // namespace sublimit
