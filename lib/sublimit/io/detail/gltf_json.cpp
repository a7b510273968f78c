// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/gltf_json.h"

#include <cmath>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

constexpr std::int64_t most_exact = std::int64_t{1} << 53;

/// A whole number of 0 to 2^53, in whichever way it is written.
std::optional<std::int64_t> whole_number(const GltfJson& value) {
  if (value.is_number_unsigned()) {
    const auto number = value.get<std::uint64_t>();
    if (number <= std::uint64_t{most_exact}) return static_cast<std::int64_t>(number);
  } else if (value.is_number_float()) {
    const auto number = value.get<double>();
    if (number >= 0 && number <= double{most_exact} && number == std::floor(number))
      return static_cast<std::int64_t>(number);
  }
  return std::nullopt;
}

}  // namespace

GltfObject::GltfObject(const GltfJson& value, const std::string& file, std::string place)
    : value_(&value), file_(&file), place_(std::move(place)) {
  if (!value.is_object()) fail(std::string("it is of type ") + value.type_name() + "; it should be an object");
}

std::string GltfObject::place() const { return *file_ + ": " + (place_.empty() ? "" : place_ + ": "); }
std::string GltfObject::field(const char* key) const { return place_.empty() ? key : place_ + "." + key; }

void GltfObject::fail(const std::string& what) const { throw FormatError(place() + what); }
void GltfObject::fail(const char* key, const std::string& what) const {
  throw FormatError(*file_ + ": " + field(key) + ": " + what);
}

std::string GltfObject::name() const { return std::string(text("name", "")); }

std::string GltfObject::in_words() const {
  const std::string_view given = text("name", "");
  return given.empty() ? place_ : place_ + " " + in_quotes(given);
}

const GltfJson* GltfObject::find(const char* key) const {
  const auto found = value_->find(key);
  return found == value_->end() ? nullptr : &*found;
}

std::int64_t GltfObject::integer(const char* key, std::int64_t fallback) const {
  const GltfJson* const value = find(key);
  if (!value) return fallback;
  if (const std::optional<std::int64_t> number = whole_number(*value)) return *number;
  fail(key, "it should be a whole number of 0 to 2^53");
}

std::int64_t GltfObject::integer(const char* key) const {
  if (!find(key)) fail(std::string("it has no '") + key + "'; it should be a whole number");
  return integer(key, 0);
}

std::int64_t GltfObject::index(const char* key, std::int64_t count, const char* array) const {
  const std::int64_t i = integer(key, -1);
  if (i >= count) fail(key, format_number(i) + " is out of range; the file has " + format_number(count) + " " + array);
  return i;
}

std::optional<double> GltfObject::number(const char* key) const {
  const GltfJson* const value = find(key);
  if (!value) return std::nullopt;
  if (!value->is_number()) fail(key, "it should be a number");
  return value->get<double>();
}

bool GltfObject::flag(const char* key) const {
  const GltfJson* const value = find(key);
  if (value && !value->is_boolean()) fail(key, "it should be true or false");
  return value && value->get<bool>();
}

std::string_view GltfObject::text(const char* key, std::string_view fallback) const {
  const GltfJson* const value = find(key);
  if (!value) return fallback;
  if (!value->is_string()) fail(key, "it should be a text");
  return value->get_ref<const std::string&>();
}

std::string_view GltfObject::text(const char* key) const {
  if (!find(key)) fail(std::string("it has no '") + key + "'; it should be a text");
  return text(key, {});
}

const GltfJson* GltfObject::find_array(const char* key) const {
  const GltfJson* const value = find(key);
  if (value && !value->is_array()) fail(key, "it should be an array");
  return value;
}

std::vector<double> GltfObject::numbers(const char* key, std::size_t count) const {
  std::vector<double> all;
  const GltfJson* const array = find_array(key);
  if (!array) return all;
  if (array->size() != count) fail(key, "it should have " + format_number(count) + " numbers");
  for (const GltfJson& one : *array) {
    if (!one.is_number()) fail(key, "it should have " + format_number(count) + " numbers");
    all.push_back(one.get<double>());
  }
  return all;
}

std::vector<std::int64_t> GltfObject::indices(const char* key, std::int64_t count, const char* array) const {
  std::vector<std::int64_t> all;
  const GltfJson* const found = find_array(key);
  if (!found) return all;
  for (const GltfJson& one : *found) {
    const std::optional<std::int64_t> i = whole_number(one);
    if (!i || *i >= count)
      fail(key, "an element is no number of one of the file's " + format_number(count) + " " + array);
    all.push_back(*i);
  }
  return all;
}

std::optional<GltfObject> GltfObject::object(const char* key) const {
  const GltfJson* const value = find(key);
  if (!value) return std::nullopt;
  return GltfObject(*value, *file_, field(key));
}

std::int64_t GltfObject::size(const char* key) const {
  const GltfJson* const array = find_array(key);
  return array ? std::ssize(*array) : 0;
}

GltfObject GltfObject::element(const char* key, std::int64_t i) const {
  return {(*find_array(key))[static_cast<std::size_t>(i)], *file_, field(key) + "[" + format_number(i) + "]"};
}

std::vector<std::string> GltfObject::keys() const {
  std::vector<std::string> all;
  for (auto one = value_->begin(); one != value_->end(); ++one) all.push_back(one.key());
  return all;
}

std::vector<std::string> GltfObject::texts(const char* key) const {
  std::vector<std::string> all;
  const GltfJson* const array = find_array(key);
  if (!array) return all;
  for (const GltfJson& one : *array) {
    if (!one.is_string()) fail(key, "its elements should be texts");
    all.push_back(one.get<std::string>());
  }
  return all;
}

}  // namespace sublimit
