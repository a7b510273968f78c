// SPDX-License-Identifier: Apache-2.0
#include "sublimit/schemes.h"

#include <algorithm>
#include <numeric>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t replace = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replace, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string option(const SchemeOptions& options, const OptionInfo& info) {
  const auto at = options.find(info.name);
  if (at == options.end()) return info.values.front();
  if (std::find(info.values.begin(), info.values.end(), at->second) == info.values.end())
    throw InvalidOption("option " + info.name + "=" + at->second + ": the value must be one of " + joined(info.values));
  return at->second;
}

void check_options(const std::string& scheme, const std::vector<OptionInfo>& known, const SchemeOptions& given) {
  std::vector<std::string> names;
  for (const OptionInfo& info : known) names.push_back(info.name);
  for (const auto& [name, value] : given)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InvalidOption("scheme " + scheme + " has no option '" + name + "'; " +
                          (names.empty() ? "it has none" : "it has " + joined(names)));
}

std::vector<std::string> nearest_scheme_names(const std::string& name, int count) {
  std::vector<std::string> names;
  for (const SchemeEntry<double>& entry : registry<double>) names.push_back(entry.name);
  // A prefix ("catmull") counts as nearer than any misspelling.
  const auto distance = [&](const std::string& other) {
    return !name.empty() && other.starts_with(name) ? 0 : edit_distance(name, other);
  };
  std::stable_sort(names.begin(), names.end(),
                   [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  names.resize(std::min(names.size(), static_cast<size_t>(count)));
  return names;
}

}  // namespace sublimit
