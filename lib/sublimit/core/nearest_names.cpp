// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/nearest_names.h"

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

}  // namespace

std::size_t name_distance(const std::string& name, const std::string& other) {
  return !name.empty() && other.starts_with(name) ? 0 : edit_distance(name, other);
}

std::vector<std::string> nearest_names(const std::string& name, std::vector<std::string> names, int count) {
  const auto distance = [&](const std::string& other) { return name_distance(name, other); };
  std::stable_sort(names.begin(), names.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  names.resize(std::min(names.size(), static_cast<size_t>(count)));
  return names;
}

}  // namespace sublimit
