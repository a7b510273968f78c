// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/typed_mask.h"

#include <algorithm>
#include <cstdlib>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

constexpr size_t most_weights = 41, most_digits = 18;

std::optional<Rational> decimal(const std::string& text) {
  Rational value = 0, unit = 1;
  bool point = false;
  size_t digits = 0;
  for (size_t i = text.starts_with('-') || text.starts_with('+') ? 1 : 0; i < text.size(); ++i) {
    if (text[i] == '.' && !point) {
      point = true;
    } else if (text[i] >= '0' && text[i] <= '9' && ++digits <= most_digits) {
      value = value * Rational(10) + Rational(text[i] - '0');
      if (point) unit *= Rational(10);
    } else {
      return std::nullopt;
    }
  }
  if (digits == 0) return std::nullopt;
  return text.starts_with('-') ? -(value / unit) : value / unit;
}

/// Words between blanks and commas.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words{""};
  for (const char c : text) {
    if (c == ' ' || c == ',' || c == '\t') {
      if (!words.back().empty()) words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// The coefficient of a mask that keeps old points: 1, and alone among every other one. The middle one if there are
/// two.
std::optional<int> kept_weight(const Symbol& a) {
  std::optional<int> own;
  const int count = static_cast<int>(a.coefficients.size());
  for (const int parity : {0, 1}) {
    int others = 0, one = -1;
    for (int j = parity; j < count; j += 2)
      if (a.coefficients[j] == 1 && one < 0)
        one = j;
      else
        others += !a.coefficients[j].is_zero();
    if (one < 0 || others > 0) continue;
    if (!own || std::abs(2 * one - (count - 1)) < std::abs(2 * *own - (count - 1))) own = one;
  }
  return own;
}

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidOption("mask: " + what + "; a mask is written like \"1 4 6 4 1 /8\" or \"1/4 3/4 3/4 1/4\"");
}

}  // namespace

std::optional<Rational> typed_number(const std::string& text) {
  const size_t slash = text.find('/');
  if (slash == std::string::npos) return decimal(text);
  const std::optional<Rational> p = decimal(text.substr(0, slash)), q = decimal(text.substr(slash + 1));
  if (!p || !q || *q <= Rational(0)) return std::nullopt;
  return *p / *q;
}

Symbol typed_mask(const std::string& text) {
  std::vector<std::string> words = words_of(text);
  Rational divisor = 1;
  if (words.size() > 1 && words[words.size() - 2] == "/") {  // `/ 8`
    words[words.size() - 2] += words.back();
    words.pop_back();
  }
  if (!words.empty() && words.back().starts_with('/')) {
    const std::optional<Rational> q = typed_number(words.back().substr(1));
    if (!q || *q <= Rational(0))
      refuse("'" + words.back() + "' at the end is no denominator: a positive number after the slash is needed");
    divisor = *q;
    words.pop_back();
  }
  if (words.size() < 2)
    refuse("at least 2 weights are needed, there " + std::string(words.size() == 1 ? "is 1" : "are none"));
  if (words.size() > most_weights)
    refuse(std::to_string(words.size()) + " weights are more than the " + std::to_string(most_weights) +
           " that are taken");
  Symbol a;
  for (size_t i = 0; i < words.size(); ++i) {
    const std::optional<Rational> weight = typed_number(words[i]);
    if (!weight)
      refuse("weight " + std::to_string(i + 1) + ", '" + words[i] +
             "', is not a number like 3, -0.125 or 5/16 (at most 18 digits)");
    a.coefficients.push_back(*weight / divisor);
  }
  const auto is_zero = [](const Rational& c) { return c.is_zero(); };
  if (std::all_of(a.coefficients.begin(), a.coefficients.end(), is_zero)) refuse("all weights are zero");
  a = trimmed(std::move(a));
  const int count = static_cast<int>(a.coefficients.size());
  if (const std::optional<int> own = kept_weight(a)) {
    a.first = -*own;
    return a;
  }
  a.first = -((count - 1) / 2);
  a.shift = count % 2 == 0 ? Number<Rational>::ratio(1, 2) : Rational(0);
  return a;
}

}  // namespace sublimit
