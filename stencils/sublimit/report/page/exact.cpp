// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/exact.h"

#include <charconv>
#include <numeric>

namespace sublimit::page {
namespace {

constexpr std::int64_t greatest = 1'000'000;

std::optional<std::int64_t> integer(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > greatest || value < -greatest)
    return std::nullopt;
  return value;
}

}  // namespace

std::optional<Fraction> fraction(const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::string_view all = text;
  const std::optional<std::int64_t> top = integer(all.substr(0, slash));
  const std::optional<std::int64_t> bottom = slash == std::string::npos ? 1 : integer(all.substr(slash + 1));
  if (!top || !bottom || *bottom <= 0) return std::nullopt;
  return Fraction{*top, *bottom};
}

std::optional<Common> common_denominator(const Json& entries) {
  Common common;
  std::vector<Fraction> fractions;
  for (const Json& entry : entries) {
    const std::optional<Fraction> f = fraction(string(at(entry, "exact")));
    if (!f) return std::nullopt;
    fractions.push_back(*f);
    common.denominator = std::lcm(common.denominator, f->bottom);
    if (common.denominator > greatest) return std::nullopt;
  }
  for (const Fraction& f : fractions) common.tops.push_back(f.top * (common.denominator / f.bottom));
  return common;
}

}  // namespace sublimit::page
