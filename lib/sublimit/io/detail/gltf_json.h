// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fields of the JSON in a glTF file. What is missing, of another type or out of range is an error that names its place:
// "scene.glb: accessors[3].count: ...".
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sublimit {

using GltfJson = nlohmann::json;

/// An object of the file.
class GltfObject {
 public:
  /// @param value  must outlive this
  /// @param file   name of the file, likewise
  /// @param place  where it is in the file: "meshes[2].primitives[0]"; empty: the whole
  /// @throws FormatError  no object
  GltfObject(const GltfJson& value, const std::string& file, std::string place);

  /// Returns the name of the file.
  const std::string& file() const { return *file_; }
  /// Returns the start of messages about the object: "scene.glb: accessors[3]: ".
  std::string place() const;
  /// Returns the name that the file has for it; empty if there is none.
  std::string name() const;
  /// Returns where it is with its name, "meshes[2] 'wheel'".
  std::string in_words() const;

  /// Returns true if there is such a field.
  bool has(const char* key) const { return find(key); }
  /// Returns a whole number of 0 to 2^53; `fallback` if the field is absent.
  std::int64_t integer(const char* key, std::int64_t fallback) const;
  /// Returns a whole number.
  /// @throws FormatError  also if it is absent
  std::int64_t integer(const char* key) const;
  /// Returns the number of an element of an array of the file, below `count`; -1 if the field is absent.
  /// @param array  name of the array, for messages
  std::int64_t index(const char* key, std::int64_t count, const char* array) const;
  /// Returns a number; nothing if the field is absent.
  std::optional<double> number(const char* key) const;
  /// Returns true or false; false if the field is absent.
  bool flag(const char* key) const;
  /// Returns a text; `fallback` if the field is absent.
  std::string_view text(const char* key, std::string_view fallback) const;
  /// Returns a text.
  /// @throws FormatError  also if it is absent
  std::string_view text(const char* key) const;
  /// Returns numbers, `count` of them; none if the field is absent.
  std::vector<double> numbers(const char* key, std::size_t count) const;
  /// Returns the numbers of elements of an array of the file.
  std::vector<std::int64_t> indices(const char* key, std::int64_t count, const char* array) const;
  /// Returns an object in a field; nothing if it is absent.
  std::optional<GltfObject> object(const char* key) const;
  /// Returns the number of elements of an array; 0 if the field is absent.
  std::int64_t size(const char* key) const;
  /// Returns an element of an array.
  /// @pre  0 <= i < size(key)
  GltfObject element(const char* key, std::int64_t i) const;
  /// Returns the names of an object's fields.
  std::vector<std::string> keys() const;
  /// Returns texts of an array; none if the field is absent.
  std::vector<std::string> texts(const char* key) const;

  /// Throws an error about the object.
  [[noreturn]] void fail(const std::string& what) const;
  /// Throws an error about a field.
  /// @param key  the field that is wrong
  [[noreturn]] void fail(const char* key, const std::string& what) const;

 private:
  const GltfJson* find(const char* key) const;
  const GltfJson* find_array(const char* key) const;
  std::string field(const char* key) const;

  const GltfJson* value_;
  const std::string* file_;
  std::string place_;
};

}  // namespace sublimit
