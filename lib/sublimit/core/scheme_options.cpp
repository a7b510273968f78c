// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/scheme_options.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstdlib>
#include <numeric>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// Masks have up to 16 times the denominator, and that is an int.
constexpr std::int64_t largest_denominator = 100'000'000, largest_numerator = 1'000'000'000;

std::optional<Ratio> reduced(std::int64_t p, std::int64_t q) {
  const std::int64_t common = std::gcd(p, q);
  p /= common;
  q /= common;
  if (std::abs(p) > largest_numerator || q > largest_denominator) return std::nullopt;
  return Ratio{static_cast<int>(p), static_cast<int>(q)};
}

/// Digits with at most one point: the number times a power of ten.
std::optional<Ratio> decimal(const std::string& text) {
  constexpr std::int64_t enough = 100'000'000'000'000'000;
  std::int64_t p = 0, q = 1;
  bool point = false, digits = false;
  for (size_t i = text.starts_with('-') ? 1 : 0; i < text.size(); ++i) {
    if (text[i] == '.' && !point) {
      point = true;
      continue;
    }
    if (text[i] < '0' || text[i] > '9' || p > enough || q > enough) return std::nullopt;
    p = 10 * p + (text[i] - '0');
    q *= point ? 10 : 1;
    digits = true;
  }
  if (!digits) return std::nullopt;
  return reduced(text[0] == '-' ? -p : p, q);
}

std::optional<Ratio> parsed(const std::string& text) {
  const size_t slash = text.find('/');
  if (slash == std::string::npos) return decimal(text);
  const auto p = decimal(text.substr(0, slash)), q = decimal(text.substr(slash + 1));
  if (!p || !q || q->p <= 0 || p->q != 1 || q->q != 1) return std::nullopt;
  return reduced(p->p, q->p);
}

[[noreturn]] void refuse(const OptionInfo& info, const std::string& value) {
  throw InvalidOption("option " + info.name + "=" + value + ": the value must be " + allowed_values(info) +
                      (info.meaning.empty() ? "" : "; " + info.meaning));
}

}  // namespace

std::string to_string(Ratio r) { return std::to_string(r.p) + (r.q == 1 ? "" : "/" + std::to_string(r.q)); }

std::string allowed_values(const OptionInfo& info) {
  if (!info.range) return "one of " + joined(info.values);
  return std::string(info.range->whole ? "a whole number" : "a number (like 0.75 or 3/4, at most 8 decimals)") +
         " from " + to_string(info.range->low) + " to " + to_string(info.range->high);
}

std::string option(const SchemeOptions& options, const OptionInfo& info) {
  const auto at = options.find(info.name);
  if (at == options.end()) return info.values.front();
  if (std::find(info.values.begin(), info.values.end(), at->second) == info.values.end()) refuse(info, at->second);
  return at->second;
}

Ratio ratio_option(const SchemeOptions& options, const OptionInfo& info) {
  const auto at = options.find(info.name);
  const std::string text = at == options.end() ? info.values.front() : at->second;
  const std::optional<Ratio> number = parsed(text);
  const auto less = [](Ratio a, Ratio b) { return std::int64_t{a.p} * b.q < std::int64_t{b.p} * a.q; };
  if (!number || less(*number, info.range->low) || less(info.range->high, *number)) refuse(info, text);
  if (info.range->whole && number->q != 1) refuse(info, text);
  return *number;
}

int whole_option(const SchemeOptions& options, const OptionInfo& info) {
  assert(info.range && info.range->whole);
  return ratio_option(options, info).p;
}

void check_options(const std::string& scheme, const std::vector<OptionInfo>& known, const SchemeOptions& given) {
  std::vector<std::string> names;
  for (const OptionInfo& info : known) names.push_back(info.name);
  for (const auto& [name, value] : given)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InvalidOption("scheme " + scheme + " has no option '" + name + "'; " +
                          (names.empty() ? "it has none" : "it has " + joined(names)));
}

}  // namespace sublimit
