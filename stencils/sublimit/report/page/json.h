// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reading a report in which any entry may be missing: missing entries are null.
#include <nlohmann/json.hpp>

#include <cmath>
#include <concepts>
#include <optional>
#include <string>

namespace sublimit::page {

using Json = nlohmann::ordered_json;

/// Returns the value of a key; null if there is none, or if `object` is not an object.
inline const Json& at(const Json& object, const char* key) {
  static const Json null;
  if (!object.is_object()) return null;
  const auto found = object.find(key);
  return found == object.end() ? null : *found;
}

inline std::optional<double> number(const Json& value) {
  if (!value.is_number()) return std::nullopt;
  const double x = value.get<double>();
  if (!std::isfinite(x)) return std::nullopt;
  return x;
}

inline int whole(const Json& value, int otherwise = 0) {
  return value.is_number_integer() ? value.get<int>() : otherwise;
}

inline std::string string(const Json& value, std::string otherwise = {}) {
  return value.is_string() ? value.get<std::string>() : otherwise;
}

inline bool is_true(const Json& value) { return value.is_boolean() && value.get<bool>(); }

/// Returns element i of an array; null if i is out of range.
template <std::integral I>
const Json& at(const Json& array, I index) {
  static const Json null;
  const std::size_t i = static_cast<std::size_t>(index);
  return array.is_array() && i < array.size() ? array[i] : null;
}

/// Returns the first verdict on a property; null if there is none.
inline const Json& verdict_on(const Json& verdicts, const char* property) {
  static const Json null;
  for (const Json& v : verdicts)
    if (string(at(v, "property")) == property) return v;
  return null;
}

}  // namespace sublimit::page
