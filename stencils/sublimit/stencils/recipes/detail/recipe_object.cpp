// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/recipes/detail/recipe_object.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/nearest_names.h"

namespace sublimit {
namespace {

std::string entry(const std::string& path, std::size_t i) { return path + "[" + format_number(i) + "]"; }

std::string from_to(std::size_t least, std::size_t most) {
  if (least == most) return format_number(least);
  return format_number(least) + (most - least == 1 ? " or " : " to ") + format_number(most);
}

}  // namespace

RecipeObject::RecipeObject(const JsonValue& value, std::string place, std::string path)
    : value_(&value), place_(std::move(place)), path_(std::move(path)) {}

void RecipeObject::fail(std::string_view field, const std::string& what) const {
  throw FormatError(place_ + ": " + path_ + std::string(field) + ": " + what);
}

void RecipeObject::finish() const {
  for (const std::string& key : value_->keys) {
    if (known_.contains(key)) continue;
    const JsonValue shown{.type = JsonValue::Type::string, .text = key, .items = {}, .keys = {}};
    std::string nearest = nearest_in_words(key, {known_.begin(), known_.end()}), all;
    for (const std::string& field : known_) all += (all.empty() ? "; the fields are " : ", ") + field;
    if (nearest.starts_with("there are")) all.clear();  // they are listed
    throw FormatError(place_ + ": unknown field " + show(shown) +
                      (path_.empty() ? "" : " in " + path_.substr(0, path_.size() - 1)) + "; " + nearest + all);
  }
}

bool RecipeObject::has(std::string_view field) {
  known_.emplace(field);
  return value_->find(field) != nullptr;
}

const JsonValue& RecipeObject::required(const std::string& field, const char* what) {
  if (!has(field)) throw FormatError(place_ + ": the field " + path_ + field + " is missing; it should be " + what);
  return *value_->find(field);
}

const JsonValue& RecipeObject::array(const std::string& field, const char* what) {
  const JsonValue& value = required(field, what);
  if (value.type != JsonValue::Type::array) fail(field, "is " + show(value) + "; it should be " + what);
  return value;
}

ExactNumber RecipeObject::number_in(const JsonValue& value, const std::string& path) const {
  if (value.type == JsonValue::Type::number && std::isfinite(value.number)) return {value.number, value.text};
  if (value.type == JsonValue::Type::string)
    if (std::optional<ExactNumber> fraction = parse_fraction(value.text)) return *std::move(fraction);
  fail(path, "is " + show(value) + "; it should be a number, or a fraction \"p/q\" of whole numbers");
}

ExactNumber RecipeObject::number(const std::string& field) { return number_in(required(field, "a number"), field); }

double RecipeObject::number_or(const std::string& field, double otherwise) {
  return has(field) ? number(field).value : otherwise;
}

int RecipeObject::integer(const std::string& field, int least, int most) {
  const JsonValue& value = required(field, "a whole number");
  if (value.type != JsonValue::Type::number || value.number != std::floor(value.number) || value.number < least ||
      value.number > most)
    fail(field, "is " + show(value) + "; it should be a whole number from " + format_number(least) + " to " +
                    format_number(most));
  return static_cast<int>(value.number);
}

int RecipeObject::integer_or(const std::string& field, int least, int most, int otherwise) {
  return has(field) ? integer(field, least, most) : otherwise;
}

bool RecipeObject::flag_or(const std::string& field, bool otherwise) {
  if (!has(field)) return otherwise;
  const JsonValue& value = *value_->find(field);
  if (value.type != JsonValue::Type::boolean) fail(field, "is " + show(value) + "; it should be true or false");
  return value.boolean;
}

std::string RecipeObject::string(const std::string& field, const char* what) {
  const JsonValue& value = required(field, what);
  if (value.type != JsonValue::Type::string) fail(field, "is " + show(value) + "; it should be " + what);
  return value.text;
}

std::size_t RecipeObject::word(const std::string& field, std::span<const char* const> words) {
  std::string names;
  for (const char* const name : words) names += (names.empty() ? "" : ", ") + std::string(name);
  const JsonValue& value = required(field, ("one of " + names).c_str());
  const auto found = std::ranges::find_if(words, [&](const char* name) { return value.text == name; });
  // Words such as "12" may come as numbers.
  const bool is_text = value.type == JsonValue::Type::string || value.type == JsonValue::Type::number;
  if (!is_text || found == words.end()) fail(field, "is " + show(value) + "; it should be one of " + names);
  return static_cast<std::size_t>(found - words.begin());
}

std::size_t RecipeObject::word_or(const std::string& field, std::span<const char* const> words, std::size_t otherwise) {
  return has(field) ? word(field, words) : otherwise;
}

std::vector<double> RecipeObject::numbers(const std::string& field) {
  const JsonValue& list = array(field, "a list of numbers");
  std::vector<double> result;
  for (std::size_t i = 0; i < list.items.size(); ++i) result.push_back(number_in(list.items[i], entry(field, i)).value);
  return result;
}

std::vector<double> RecipeObject::numbers(const std::string& field, std::size_t count) {
  std::vector<double> result = numbers(field);
  if (result.size() != count)
    fail(field, "has " + format_number(result.size()) + " numbers; it should have " + format_number(count));
  return result;
}

std::vector<int> RecipeObject::integers(const std::string& field, std::size_t count, int least, int most) {
  std::vector<int> result;
  const std::vector<double> all = numbers(field, count);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] != std::floor(all[i]) || all[i] < least || all[i] > most)
      fail(entry(field, i), "is " + format_number(all[i]) + "; it should be a whole number from " +
                                format_number(least) + " to " + format_number(most));
    result.push_back(static_cast<int>(all[i]));
  }
  return result;
}

std::vector<bool> RecipeObject::flags_or(const std::string& field, std::size_t count, bool otherwise) {
  if (!has(field)) return std::vector<bool>(count, otherwise);
  const JsonValue& list = array(field, "a list of true and false");
  std::vector<bool> result;
  for (const JsonValue& item : list.items) {
    if (item.type != JsonValue::Type::boolean) fail(field, "holds " + show(item) + "; it should be true or false");
    result.push_back(item.boolean);
  }
  if (result.size() != count)
    fail(field, "has " + format_number(result.size()) + " entries; it should have " + format_number(count));
  return result;
}

ExactPoints RecipeObject::points_in(const JsonValue& list, const std::string& path, std::size_t least,
                                    std::size_t most) const {
  if (list.type != JsonValue::Type::array) fail(path, "is " + show(list) + "; it should be a list of points");
  ExactPoints result;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const JsonValue& item = list.items[i];
    if (item.type != JsonValue::Type::array)
      fail(entry(path, i), "is " + show(item) + "; it should be a list of " + from_to(least, most) + " numbers");
    if (item.items.size() < least || item.items.size() > most)
      fail(entry(path, i),
           "has " + format_number(item.items.size()) + " numbers; it should have " + from_to(least, most));
    if (i > 0 && item.items.size() != result[0].size())
      fail(entry(path, i), "has " + format_number(item.items.size()) + " numbers, those before have " +
                               format_number(result[0].size()));
    std::vector<ExactNumber> row;
    for (std::size_t k = 0; k < item.items.size(); ++k)
      row.push_back(number_in(item.items[k], entry(entry(path, i), k)));
    result.push_back(std::move(row));
  }
  if (result.empty()) fail(path, "is empty; it should be a list of points");
  return result;
}

ExactPoints RecipeObject::exact_points(const std::string& field, std::size_t least, std::size_t most) {
  return points_in(array(field, "a list of points"), field, least, most);
}

Points RecipeObject::points(const std::string& field, std::size_t least, std::size_t most) {
  return rounded(exact_points(field, least, most));
}

Points RecipeObject::space_points(const std::string& field) { return in_space(points(field, 2, 3)); }

Points RecipeObject::space_points(const std::string& field, Eigen::Index count) {
  Points result = space_points(field);
  if (result.rows() != count)
    fail(field, "has " + format_number(result.rows()) + " points; it should have " + format_number(count));
  return result;
}

Eigen::RowVector3d RecipeObject::space_vector(const std::string& field) {
  const std::vector<double> all = numbers(field);
  if (all.size() != 2 && all.size() != 3)
    fail(field, "has " + format_number(all.size()) + " numbers; it should have 2 or 3");
  return {all[0], all[1], all.size() == 3 ? all[2] : 0};
}

std::vector<Points> RecipeObject::lists_of_points(const std::string& field, std::size_t least, std::size_t most) {
  const JsonValue& list = array(field, "a list of lists of points");
  std::vector<Points> result;
  for (std::size_t i = 0; i < list.items.size(); ++i)
    result.push_back(rounded(points_in(list.items[i], entry(field, i), least, most)));
  return result;
}

RecipeObject RecipeObject::object(const std::string& field, const char* what) {
  const JsonValue& value = required(field, what);
  if (value.type != JsonValue::Type::object) fail(field, "is " + show(value) + "; it should be " + what);
  return {value, place_, path_ + field + "."};
}

std::vector<RecipeObject> RecipeObject::objects(const std::string& field, const char* what) {
  const JsonValue& list = array(field, what);
  std::vector<RecipeObject> result;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    if (list.items[i].type != JsonValue::Type::object)
      fail(entry(field, i), "is " + show(list.items[i]) + "; it should be an object");
    result.emplace_back(list.items[i], place_, path_ + entry(field, i) + ".");
  }
  return result;
}

Points rounded(const ExactPoints& points) {
  Points result(std::ssize(points), points.empty() ? 0 : std::ssize(points[0]));
  for (Eigen::Index i = 0; i < result.rows(); ++i)
    for (Eigen::Index k = 0; k < result.cols(); ++k) result(i, k) = points[size_t(i)][size_t(k)].value;
  return result;
}

Points in_space(Points points) {
  if (points.cols() == 3) return points;
  points.conservativeResize(Eigen::NoChange, 3);
  points.col(2).setZero();
  return points;
}

}  // namespace sublimit
