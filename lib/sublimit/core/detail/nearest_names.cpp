// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/nearest_names.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sublimit {
namespace {

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

/// Letters to insert, delete or replace to make `other` of `name`; 0 if `other` begins with it.
size_t name_distance(const std::string& name, const std::string& other) {
  return !name.empty() && other.starts_with(name) ? 0 : edit_distance(name, other);
}

}  // namespace

std::vector<std::string> nearest_names(const std::string& name, std::vector<std::string> names, int count) {
  const auto distance = [&](const std::string& other) { return name_distance(name, other); };
  std::stable_sort(names.begin(), names.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  names.resize(std::min(names.size(), static_cast<size_t>(count)));
  if (names.empty()) return names;
  // With half of the letters wrong it is a guess, not a correction.
  const size_t most = std::min(distance(names.front()) + 1, (name.size() + 1) / 2);
  std::erase_if(names, [&](const std::string& other) { return distance(other) > most; });
  return names;
}

std::string nearest_in_words(const std::string& name, const std::vector<std::string>& names) {
  const std::vector<std::string> near = nearest_names(name, names);
  std::string text;
  for (const std::string& one : near.empty() ? names : near) text += (text.empty() ? "" : ", ") + one;
  return (near.empty() ? "there are " : "the nearest are ") + text;
}

}  // namespace sublimit
