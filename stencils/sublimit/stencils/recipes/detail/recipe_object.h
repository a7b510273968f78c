// SPDX-License-Identifier: Apache-2.0
#pragma once
// The fields of an object in a recipe, read by name. Fields that are missing, unknown or of another kind are
// errors that name the file, the object, the field, and what would be right.
#include <initializer_list>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/stencils/recipes/detail/exact_number.h"
#include "sublimit/stencils/recipes/detail/json_value.h"

namespace sublimit {

class RecipeObject {
 public:
  /// @param value  must outlive this
  /// @param place  start of messages: "file.json: recipe 2 'wing' (ruled)"
  /// @param path   path of the object in the recipe: "" or "c0."
  RecipeObject(const JsonValue& value, std::string place, std::string path = "");
  RecipeObject(const JsonValue&&, std::string, std::string = "") = delete;

  const std::string& place() const { return place_; }
  const JsonValue& value() const { return *value_; }

  /// @throws FormatError
  [[noreturn]] void fail(std::string_view field, const std::string& what) const;
  /// To be called after all reads: checks that there are no other fields.
  /// @throws FormatError  a field that was not read; the message has the nearest names
  void finish() const;

  bool has(std::string_view field);
  const JsonValue& required(const std::string& field, const char* what);

  ExactNumber number(const std::string& field);
  double number_or(const std::string& field, double otherwise);
  int integer(const std::string& field, int least, int most);
  int integer_or(const std::string& field, int least, int most, int otherwise);
  bool flag_or(const std::string& field, bool otherwise);
  std::string string(const std::string& field, const char* what);
  /// Returns the number of a field's word among `words`.
  std::size_t word(const std::string& field, std::span<const char* const> words);
  std::size_t word_or(const std::string& field, std::span<const char* const> words, std::size_t otherwise);

  std::vector<double> numbers(const std::string& field);
  /// Returns `count` numbers.
  std::vector<double> numbers(const std::string& field, std::size_t count);
  std::vector<int> integers(const std::string& field, std::size_t count, int least, int most);
  std::vector<bool> flags_or(const std::string& field, std::size_t count, bool otherwise);
  /// Returns rows of numbers of equal length, `least` to `most` numbers in each.
  ExactPoints exact_points(const std::string& field, std::size_t least, std::size_t most);
  Points points(const std::string& field, std::size_t least, std::size_t most);
  /// Returns points in space; z is 0 for points of two numbers.
  Points space_points(const std::string& field);
  /// Returns `count` points in space.
  Points space_points(const std::string& field, Eigen::Index count);
  /// Returns a vector [x, y] or [x, y, z]; z is 0 if absent.
  Eigen::RowVector3d space_vector(const std::string& field);
  /// Returns the lists of points in an array, with `least` to `most` coordinates for each point.
  std::vector<Points> lists_of_points(const std::string& field, std::size_t least, std::size_t most);

  RecipeObject object(const std::string& field, const char* what);
  std::vector<RecipeObject> objects(const std::string& field, const char* what);

 private:
  const JsonValue& array(const std::string& field, const char* what);
  ExactNumber number_in(const JsonValue& value, const std::string& path) const;
  ExactPoints points_in(const JsonValue& value, const std::string& path, std::size_t least, std::size_t most) const;

  const JsonValue* value_;
  std::string place_, path_;
  std::set<std::string, std::less<>> known_;
};

/// Returns exact points rounded to doubles.
Points rounded(const ExactPoints& points);
/// Returns points of 3 columns from points of 2 or 3 columns, with z = 0.
Points in_space(Points points);

}  // namespace sublimit
