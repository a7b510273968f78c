// SPDX-License-Identifier: Apache-2.0
// Algebraic numbers as text, and back.
#include <charconv>
#include <memory>
#include <numeric>
#include <sstream>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/certificates/numbers/detail/flint_value.h"

namespace sublimit {
namespace {

std::string text_of(const fmpq* q) {
  return std::unique_ptr<char, decltype(&flint_free)>(fmpq_get_str(nullptr, 10, q), flint_free).get();
}

std::string coefficient(const fmpq_poly_struct* p, long i) {
  FlintRatio q;
  fmpq_poly_get_coeff_fmpq(q, p, i);
  return text_of(q);
}

/// `terms`, a sum of factor * name, with signs between.
std::string sum_of(const std::vector<std::pair<std::string, std::string>>& terms) {
  std::string sum;
  for (const auto& [factor, name] : terms) {
    if (factor == "0") continue;
    if (!sum.empty() && factor[0] != '-') sum += '+';
    if (name.empty())
      sum += factor;
    else if (factor == "1" || factor == "-1")
      sum += (factor == "1" ? "" : "-") + name;
    else
      sum += factor + "*" + name;
  }
  return sum.empty() ? "0" : sum;
}

/// a + b cos(2 pi k/N) for the least k that there is, "" for none.
std::string as_cosine(const Algebraic& x) {
  for (long k = 1; k <= x.order() / 2; ++k) {
    const Algebraic cosine = Number<Algebraic>::cos_2pi(static_cast<int>(k), static_cast<int>(x.order()));
    if (cosine.order() != x.order()) continue;
    // The highest coefficients must agree; then the rest must.
    const long top = fmpq_poly_degree(cosine.polynomial());
    if (top != fmpq_poly_degree(x.polynomial())) continue;
    FlintRatio own, of_cosine;
    fmpq_poly_get_coeff_fmpq(own, x.polynomial(), top);
    fmpq_poly_get_coeff_fmpq(of_cosine, cosine.polynomial(), top);
    fmpq_div(own, own, of_cosine);
    const Algebraic rest = x - Algebraic(own) * cosine;
    if (!rest.is_rational()) continue;
    const long common = std::gcd(2 * k, x.order());
    const std::string turns = 2 * k == common ? "" : std::to_string(2 * k / common);
    return sum_of({{coefficient(rest.polynomial(), 0), ""},
                   {text_of(own), "cos(" + turns + "pi/" + std::to_string(x.order() / common) + ")"}});
  }
  return "";
}

}  // namespace

std::string Algebraic::text() const {
  if (is_rational()) return coefficient(p_, 0);
  if (const std::string cosine = as_cosine(*this); !cosine.empty()) return cosine;
  std::vector<std::pair<std::string, std::string>> terms;
  for (long i = 0; i < fmpq_poly_length(p_); ++i)
    terms.emplace_back(coefficient(p_, i), i == 0 ? "" : i == 1 ? "z" : "z^" + std::to_string(i));
  return sum_of(terms) + ", z = exp(2pi i/" + std::to_string(order_) + ")";
}

std::string Algebraic::exact_text() const {
  if (is_rational()) return coefficient(p_, 0);
  std::string all = "[" + std::to_string(order_) + "]";
  for (long i = 0; i < fmpq_poly_length(p_); ++i) all += " " + coefficient(p_, i);
  return all;
}

Algebraic Algebraic::parse(std::string_view text) {
  const auto bad = [&] {
    return FormatError("\"" + std::string(text) +
                       "\" is no algebraic number: a fraction (9/64) was expected, or [N] and the coefficients of the "
                       "powers of exp(2 pi i/N) ([5] 1/2 0 1)");
  };
  while (text.starts_with(' ')) text.remove_prefix(1);
  std::istringstream in{std::string(text)};
  long order = 1;
  if (text.starts_with('[')) {
    char bracket = 0;
    if (!(in >> bracket >> order >> bracket) || bracket != ']' || order < 3 || order > 1000000 || order % 4 == 2)
      throw bad();
  }
  Algebraic r;
  long i = 0;
  for (std::string word; in >> word; ++i) {
    FlintRatio q;
    if (i > order || fmpq_set_str(q, word.c_str(), 10) != 0 || fmpz_is_zero(fmpq_denref(q))) throw bad();
    fmpq_canonicalise(q);
    fmpq_poly_set_coeff_fmpq(r.p_, i, q);
  }
  if (i == 0 || (order == 1 && i > 1)) throw bad();
  r.order_ = order;
  r.reduce();
  return r;
}

}  // namespace sublimit
