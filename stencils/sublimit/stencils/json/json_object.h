// SPDX-License-Identifier: Apache-2.0
#pragma once
// The fields of a JSON object, read by name. Fields that are missing, unknown or of another kind are errors that name
// the file, the object, the field, and what would be right.
//
//   JsonObject object(value, "bake.json");
//   const int levels = object.integer_or("levels", 0, 11, 2);
//   object.finish();  // no other fields
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/stencils/json/exact_number.h"
#include "sublimit/stencils/json/json_value.h"

namespace sublimit {

/// An object and the fields of it that have been read.
class JsonObject {
 public:
  /// @param value  must outlive this
  /// @param place  start of messages: "file.json: recipe 2 'wing' (ruled)"
  /// @param path   path of the object in the file: "" or "c0."
  JsonObject(const JsonValue& value, std::string place, std::string path = "");
  JsonObject(const JsonValue&&, std::string, std::string = "") = delete;

  /// Returns the start of messages.
  const std::string& place() const { return place_; }
  /// Returns the object as it was read.
  const JsonValue& value() const { return *value_; }

  /// Throws an error about a field.
  /// @param what  what is wrong, and what would be right
  /// @throws FormatError
  [[noreturn]] void fail(std::string_view field, const std::string& what) const;
  /// To be called after all reads: checks that there are no other fields.
  /// @throws FormatError  a field that was not read; the message has the nearest names
  void finish() const;
  /// Returns the fields that were not read, in the order of the file.
  std::vector<std::string> unread() const;
  /// Returns the fields that may be meant by a misspelt one, nearest first.
  std::vector<std::string> nearest(const std::string& field) const;

  // Below, a field of another kind is a FormatError, and so is one that is missing unless a value is given instead.

  /// Returns true if there is such a field, which counts as read.
  bool has(std::string_view field);
  /// Returns the value of a field.
  /// @param what  what it should be, for the message
  const JsonValue& required(const std::string& field, const std::string& what);
  const JsonValue& required(const std::string& field, const std::string& what, JsonValue::Type type);

  /// Returns a number, or a ratio in quotes.
  ExactNumber number(const std::string& field);
  /// Returns a number, or another if it is missing.
  double number_or(const std::string& field, double otherwise);
  /// Returns a whole number from `least` to `most`.
  int integer(const std::string& field, int least, int most);
  /// Returns such a number, or another if it is missing.
  int integer_or(const std::string& field, int least, int most, int otherwise);
  /// Returns true or false, or another value if it is missing.
  bool flag_or(const std::string& field, bool otherwise);
  /// Returns a text.
  /// @param what  what it should be, for the message
  std::string string(const std::string& field, const std::string& what);
  /// Returns the number of a field's word among `words`.
  std::size_t word(const std::string& field, std::span<const char* const> words);
  /// Returns such a number, or another if the field is missing.
  std::size_t word_or(const std::string& field, std::span<const char* const> words, std::size_t otherwise);

  /// Returns a list of numbers.
  std::vector<double> numbers(const std::string& field);
  /// Returns `count` numbers.
  std::vector<double> numbers(const std::string& field, std::size_t count);
  /// Returns a list of integers.
  /// @param what  what each of them is, for the message: "a vertex"
  std::vector<int> integers(const std::string& field, int least, int most, const char* what = "a whole number");
  /// Returns `count` integers.
  std::vector<int> integers(const std::string& field, std::size_t count, int least, int most);
  /// Returns `count` flags, or all of them as `otherwise` if they are missing.
  std::vector<bool> flags_or(const std::string& field, std::size_t count, bool otherwise);

  /// Returns the path of an entry in a list: "points[3]".
  static std::string entry(const std::string& path, std::size_t i);

 protected:
  ExactNumber number_in(const JsonValue& value, const std::string& path) const;
  int integer_in(const JsonValue& value, const std::string& path, int least, int most, const char* what) const;
  void check_size(const std::string& field, std::size_t size, std::size_t count, const char* of) const;

  const JsonValue* value_;
  std::string place_, path_;

 private:
  std::set<std::string, std::less<>> known_;
};

/// Checks that a file holds an object.
/// @param advice  what the file should hold, for the message: "a sidecar is an object such as {..}"
/// @throws FormatError
void require_object(const JsonValue& root, const std::string& place, const std::string& advice);

}  // namespace sublimit
