// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "sublimit/base/error.h"
#include "sublimit/report/analysis/scheme_report.h"

namespace sublimit::report {
namespace {

constexpr const char* usage = "valences are numbers and ranges, as in 3-12 or 3-8,12";

int whole(std::string_view text, const std::string& all) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range)
    throw InvalidOption(fmt::format("--valence {}: {} is beyond {}; {}", all, text, greatest_valence, usage));
  if (error != std::errc() || end != text.data() + text.size() || text.empty())
    throw InvalidOption(fmt::format("--valence {}: '{}' is no number; {}", all, text, usage));
  return value;
}

/// What one neighbourhood of this valence would take: dense matrices of some 30 n points, made thrice, and their
/// eigenvalues.
std::string cost(int valence) {
  const double n = valence, bytes = 3 * 8 * (30 * n) * (30 * n), hours = 3e-8 * n * n * n * n / 3600 * 20;
  return fmt::format("about {:.3g} GB of memory and {:.0f} hours", bytes / 1e9, std::max(hours, 1.0));
}

}  // namespace

std::vector<int> parse_valences(const std::string& text) {
  std::set<int> valences;
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find(',', at), text.size());
    const std::string_view item = std::string_view(text).substr(at, end - at);
    const size_t dash = item.find('-', 1);
    const int first = whole(item.substr(0, std::min(dash, item.size())), text),
              last = dash == std::string_view::npos ? first : whole(item.substr(dash + 1), text);
    if (first > last)
      throw InvalidOption(fmt::format("--valence {}: {} is empty; did you mean {}-{}?", text, item, last, first));
    if (first < least_valence)
      throw InvalidOption(
          fmt::format("--valence {}: {} is below {}, the least valence of a closed fan", text, first, least_valence));
    if (last > greatest_valence)
      throw InvalidOption(
          fmt::format("--valence {}: {} is beyond {}; a scheme would take {}. Verdicts do not change from "
                      "some valence on, so 3-{} tells as much",
                      text, last, greatest_valence, cost(last), greatest_valence));
    for (int n = first; n <= last; ++n) valences.insert(n);
    at = end + 1;
  }
  return {valences.begin(), valences.end()};
}

}  // namespace sublimit::report
