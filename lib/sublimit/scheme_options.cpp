// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme_options.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <numeric>
#include <optional>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string in_words(Ratio r) {
  return r.q == 1 ? std::to_string(r.p) : std::to_string(r.p) + "/" + std::to_string(r.q);
}

/// Digits with at most one point: the number times a power of ten.
std::optional<Ratio> decimal(const std::string& text) {
  std::int64_t p = 0, q = 1;
  bool point = false, digits = false;
  for (size_t i = text.starts_with('-') ? 1 : 0; i < text.size(); ++i) {
    if (text[i] == '.' && !point) {
      point = true;
      continue;
    }
    if (text[i] < '0' || text[i] > '9' || p > 100'000'000 || q > 100'000'000) return std::nullopt;
    p = 10 * p + (text[i] - '0');
    q *= point ? 10 : 1;
    digits = true;
  }
  if (!digits) return std::nullopt;
  const std::int64_t common = std::gcd(p, q);
  return Ratio{static_cast<int>((text[0] == '-' ? -p : p) / common), static_cast<int>(q / common)};
}

std::optional<Ratio> parsed(const std::string& text) {
  const size_t slash = text.find('/');
  if (slash == std::string::npos) return decimal(text);
  const auto p = decimal(text.substr(0, slash)), q = decimal(text.substr(slash + 1));
  if (!p || !q || q->p <= 0 || p->q != 1 || q->q != 1) return std::nullopt;
  const int common = std::gcd(p->p, q->p);
  return Ratio{p->p / common, q->p / common};
}

}  // namespace

std::string option(const SchemeOptions& options, const OptionInfo& info) {
  const auto at = options.find(info.name);
  if (at == options.end()) return info.values.front();
  if (std::find(info.values.begin(), info.values.end(), at->second) == info.values.end())
    throw InvalidOption("option " + info.name + "=" + at->second + ": the value must be one of " + joined(info.values));
  return at->second;
}

Ratio ratio_option(const SchemeOptions& options, const OptionInfo& info, Ratio low, Ratio high) {
  const auto at = options.find(info.name);
  const std::string text = at == options.end() ? info.values.front() : at->second;
  const std::optional<Ratio> number = parsed(text);
  const auto less = [](Ratio a, Ratio b) { return std::int64_t{a.p} * b.q < std::int64_t{b.p} * a.q; };
  if (!number || less(*number, low) || less(high, *number))
    throw InvalidOption("option " + info.name + "=" + text + ": the value must be a number (like 0.75 or 3/4) from " +
                        in_words(low) + " to " + in_words(high) + "; " + info.meaning);
  return *number;
}

int whole_option(const SchemeOptions& options, const OptionInfo& info, int low, int high) {
  const auto at = options.find(info.name);
  const std::string text = at == options.end() ? info.values.front() : at->second;
  int number = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failed != std::errc{} || end != text.data() + text.size() || number < low || number > high)
    throw InvalidOption("option " + info.name + "=" + text + ": the value must be a whole number from " +
                        std::to_string(low) + " to " + std::to_string(high) + "; " + info.meaning);
  return number;
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
