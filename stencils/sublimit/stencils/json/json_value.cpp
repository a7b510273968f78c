// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/json/json_value.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <unordered_set>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using nlohmann::json;

class TreeBuilder : public nlohmann::json_sax<json> {
 public:
  TreeBuilder(std::string_view text, const std::string& name, std::optional<std::int64_t> line)
      : text_(text), name_(line ? name + ":" + format_number(*line) : name), is_line_(line) {}

  JsonValue take() { return std::move(root_); }

  bool null() override { return add({}); }
  bool boolean(bool value) override {
    JsonValue item{.type = JsonValue::Type::boolean, .text = {}, .items = {}, .keys = {}};
    item.boolean = value;
    return add(std::move(item));
  }
  bool number_integer(std::int64_t value) override { return add_number(double(value), format_number(value)); }
  bool number_unsigned(std::uint64_t value) override { return add_number(double(value), format_number(value)); }
  bool number_float(double value, const std::string& digits) override { return add_number(value, digits); }
  bool string(std::string& value) override {
    return add({.type = JsonValue::Type::string, .text = std::move(value), .items = {}, .keys = {}});
  }
  bool binary(json::binary_t&) override { return false; }
  bool start_object(std::size_t) override { return begin(JsonValue::Type::object); }
  bool key(std::string& value) override {
    if (!keys_.back().insert(value).second) fail("has the field " + show_text(value) + " twice");
    open_.back().keys.push_back(std::move(value));
    return true;
  }
  bool end_object() override { return end(); }
  bool start_array(std::size_t) override { return begin(JsonValue::Type::array); }
  bool end_array() override { return end(); }
  bool parse_error(std::size_t position, const std::string&, const json::exception& error) override {
    const auto last = text_.begin() + static_cast<std::ptrdiff_t>(std::min(position, text_.size()));
    const std::string message = error.what();
    const std::size_t bracket = message.find("] ");  // behind the name of the exception
    const std::string line = is_line_ ? "" : ":" + format_number(1 + std::count(text_.begin(), last, '\n'));
    std::string what = bracket == std::string::npos ? message : message.substr(bracket + 2);
    const std::string own = " at line 1, ";  // of a text that is one line of a file
    if (const std::size_t at = what.find(own); is_line_ && at != std::string::npos)
      what.replace(at, own.size(), " at ");
    throw FormatError(name_ + line + ": not JSON: " + what);
  }

 private:
  static constexpr std::size_t deepest = 64;

  [[noreturn]] void fail(const std::string& what) const { throw FormatError(name_ + ": " + what); }

  bool add_number(double value, std::string digits) {
    JsonValue item{.type = JsonValue::Type::number, .text = std::move(digits), .items = {}, .keys = {}};
    item.number = value;
    return add(std::move(item));
  }
  bool add(JsonValue item) {
    if (open_.empty())
      root_ = std::move(item);
    else
      open_.back().items.push_back(std::move(item));
    return true;
  }
  bool begin(JsonValue::Type type) {
    if (open_.size() >= deepest)
      fail("nests deeper than " + format_number(deepest) + " levels, the most that are read");
    open_.push_back({.type = type, .text = {}, .items = {}, .keys = {}});
    keys_.emplace_back();
    return true;
  }
  bool end() {
    JsonValue done = std::move(open_.back());
    open_.pop_back(), keys_.pop_back();
    return add(std::move(done));
  }

  std::string_view text_;
  std::string name_;
  bool is_line_;
  JsonValue root_;
  std::vector<JsonValue> open_;
  std::vector<std::unordered_set<std::string>> keys_;  // of each open value
};

}  // namespace

const JsonValue* JsonValue::find(std::string_view key) const {
  const auto found = std::ranges::find(keys, key);
  return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

JsonValue parse_json(std::string_view text, const std::string& name, std::optional<std::int64_t> line) {
  TreeBuilder builder(text, name, line);
  if (!json::sax_parse(text.begin(), text.end(), &builder)) throw FormatError(name + ": not JSON");
  return builder.take();
}

std::string show(const JsonValue& value) {
  switch (value.type) {
    case JsonValue::Type::null:
      return "null";
    case JsonValue::Type::boolean:
      return value.boolean ? "true" : "false";
    case JsonValue::Type::number:
      return value.text.substr(0, 40);
    case JsonValue::Type::string:
      return show_text(value.text);
    case JsonValue::Type::array:
      return "an array";
    default:
      return "an object";
  }
}

std::string show_text(const std::string& text) {
  return json(text).dump(-1, ' ', true, json::error_handler_t::replace).substr(0, 40);
}

}  // namespace sublimit
