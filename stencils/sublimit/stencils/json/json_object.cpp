// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/json/json_object.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/nearest_names.h"

namespace sublimit {
JsonObject::JsonObject(const JsonValue& value, std::string place, std::string path)
    : value_(&value), place_(std::move(place)), path_(std::move(path)) {}

void JsonObject::fail(std::string_view field, const std::string& what) const {
  throw FormatError(place_ + ": " + path_ + std::string(field) + ": " + what);
}

void JsonObject::finish() const {
  const std::vector<std::string> others = unread();
  if (others.empty()) return;
  std::string nearest = nearest_in_words(others[0], {known_.begin(), known_.end()}), all;
  for (const std::string& field : known_) all += (all.empty() ? "; the fields are " : ", ") + field;
  if (nearest.starts_with("there are")) all.clear();  // they are listed
  throw FormatError(place_ + ": unknown field " + show_text(others[0]) +
                    (path_.empty() ? "" : " in " + path_.substr(0, path_.size() - 1)) + "; " + nearest + all);
}

std::vector<std::string> JsonObject::unread() const {
  std::vector<std::string> others;
  std::ranges::remove_copy_if(value_->keys, std::back_inserter(others),
                              [&](const std::string& key) { return known_.contains(key); });
  return others;
}

std::vector<std::string> JsonObject::nearest(const std::string& field) const {
  return nearest_names(field, {known_.begin(), known_.end()});
}

bool JsonObject::has(std::string_view field) {
  known_.emplace(field);
  return value_->find(field) != nullptr;
}

const JsonValue& JsonObject::required(const std::string& field, const std::string& what) {
  if (!has(field)) throw FormatError(place_ + ": the field " + path_ + field + " is missing; it should be " + what);
  return *value_->find(field);
}

const JsonValue& JsonObject::required(const std::string& field, const std::string& what, JsonValue::Type type) {
  const JsonValue& value = required(field, what);
  if (value.type != type) fail(field, "is " + show(value) + "; it should be " + what);
  return value;
}

ExactNumber JsonObject::number_in(const JsonValue& value, const std::string& path) const {
  if (value.type == JsonValue::Type::number && std::isfinite(value.number)) return {value.number, value.text};
  if (value.type == JsonValue::Type::string)
    if (std::optional<ExactNumber> fraction = parse_fraction(value.text)) return *std::move(fraction);
  fail(path, "is " + show(value) + "; it should be a number, or a fraction \"p/q\" of whole numbers");
}

ExactNumber JsonObject::number(const std::string& field) { return number_in(required(field, "a number"), field); }

double JsonObject::number_or(const std::string& field, double otherwise) {
  return has(field) ? number(field).value : otherwise;
}

int JsonObject::integer_in(const JsonValue& value, const std::string& path, int least, int most,
                           const char* what) const {
  if (value.type == JsonValue::Type::number && value.number == std::floor(value.number) && value.number >= least &&
      value.number <= most)
    return static_cast<int>(value.number);
  fail(path,
       "is " + show(value) + "; it should be " + what + " from " + format_number(least) + " to " + format_number(most));
}

int JsonObject::integer(const std::string& field, int least, int most) {
  return integer_in(required(field, "a whole number"), field, least, most, "a whole number");
}

int JsonObject::integer_or(const std::string& field, int least, int most, int otherwise) {
  return has(field) ? integer(field, least, most) : otherwise;
}

bool JsonObject::flag_or(const std::string& field, bool otherwise) {
  if (!has(field)) return otherwise;
  const JsonValue& value = *value_->find(field);
  if (value.type != JsonValue::Type::boolean) fail(field, "is " + show(value) + "; it should be true or false");
  return value.boolean;
}

std::string JsonObject::string(const std::string& field, const std::string& what) {
  return required(field, what, JsonValue::Type::string).text;
}

std::size_t JsonObject::word(const std::string& field, std::span<const char* const> words) {
  std::string names;
  for (const char* const name : words) names += (names.empty() ? "" : ", ") + std::string(name);
  const JsonValue& value = required(field, "one of " + names);
  const auto found = std::ranges::find_if(words, [&](const char* name) { return value.text == name; });
  // Words such as "12" may come as numbers.
  const bool is_text = value.type == JsonValue::Type::string || value.type == JsonValue::Type::number;
  if (!is_text || found == words.end()) fail(field, "is " + show(value) + "; it should be one of " + names);
  return static_cast<std::size_t>(found - words.begin());
}

std::size_t JsonObject::word_or(const std::string& field, std::span<const char* const> words, std::size_t otherwise) {
  return has(field) ? word(field, words) : otherwise;
}

void JsonObject::check_size(const std::string& field, std::size_t size, std::size_t count, const char* of) const {
  if (size != count) fail(field, "has " + format_number(size) + " " + of + "; it should have " + format_number(count));
}

std::vector<double> JsonObject::numbers(const std::string& field) {
  const JsonValue& list = required(field, "a list of numbers", JsonValue::Type::array);
  std::vector<double> result;
  for (const JsonValue& item : list.items) result.push_back(number_in(item, entry(field, result.size())).value);
  return result;
}

std::vector<double> JsonObject::numbers(const std::string& field, std::size_t count) {
  std::vector<double> result = numbers(field);
  check_size(field, result.size(), count, "numbers");
  return result;
}

std::vector<int> JsonObject::integers(const std::string& field, int least, int most, const char* what) {
  const JsonValue& list = required(field, "a list of numbers", JsonValue::Type::array);
  std::vector<int> result;
  for (const JsonValue& item : list.items)
    result.push_back(integer_in(item, entry(field, result.size()), least, most, what));
  return result;
}

std::vector<int> JsonObject::integers(const std::string& field, std::size_t count, int least, int most) {
  const std::vector<int> result = integers(field, least, most);
  check_size(field, result.size(), count, "numbers");
  return result;
}

std::vector<bool> JsonObject::flags_or(const std::string& field, std::size_t count, bool otherwise) {
  if (!has(field)) return std::vector<bool>(count, otherwise);
  const JsonValue& list = required(field, "a list of true and false", JsonValue::Type::array);
  std::vector<bool> result;
  for (const JsonValue& item : list.items) {
    if (item.type != JsonValue::Type::boolean) fail(field, "holds " + show(item) + "; it should be true or false");
    result.push_back(item.boolean);
  }
  check_size(field, result.size(), count, "entries");
  return result;
}

std::string JsonObject::entry(const std::string& path, std::size_t i) { return path + "[" + format_number(i) + "]"; }

void require_object(const JsonValue& root, const std::string& place, const std::string& advice) {
  if (root.type != JsonValue::Type::object) throw FormatError(place + ": holds " + show(root) + "; " + advice);
}

}  // namespace sublimit
