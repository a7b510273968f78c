// SPDX-License-Identifier: Apache-2.0
#pragma once
// JSON as a tree that keeps the digits of numbers as they were written.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sublimit {

/// A value, with those that it holds.
struct JsonValue {
  enum class Type { null, boolean, number, string, array, object };
  Type type = Type::null;
  bool boolean = false;
  double number = 0;
  std::string text;  ///< text of a string, or digits of a number
  std::vector<JsonValue> items;
  std::vector<std::string> keys;  ///< keys of an object, one for each item

  /// Returns the value of a key of an object; null if there is none.
  const JsonValue* find(std::string_view key) const;
};

/// Parses JSON.
/// @param name  name of the file, for messages
/// @param line  number of the line that the text is, if the file has an object in each line; else lines are counted
/// @throws FormatError  not JSON, with file:line; a key that comes twice in an object; more than 64 levels of nesting;
///                      numbers beyond the largest double
JsonValue parse_json(std::string_view text, const std::string& name, std::optional<std::int64_t> line = {});

/// Returns a value as text for messages: "an array", "2.5", "\"smooth\"".
std::string show(const JsonValue& value);
/// Returns a text as `show` does for a string: in quotes, shortened.
std::string show_text(const std::string& text);

}  // namespace sublimit
