// SPDX-License-Identifier: Apache-2.0
#pragma once
// The header of a PLY file: the elements with their counts and the properties of each.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

using PlyType = ValueType;
std::int64_t byte_size(PlyType type);
bool is_integer(PlyType type);
/// The numbers that a type holds, and its name in headers.
struct PlyRange {
  const char* name;
  double least, most;
};
PlyRange range_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type;                   ///< of the value, or of each value of a list
  std::optional<PlyType> length;  ///< for lists: type of the number of values, which precedes them
  std::int64_t line = 0;
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
  std::int64_t line = 0;
};

/// Returns the bytes of a row in binary data; absent if rows have lists.
std::optional<std::int64_t> row_size(const PlyElement& element);

struct PlyHeader {
  enum class Encoding { text, little_endian, big_endian };
  Encoding encoding = Encoding::text;
  std::vector<PlyElement> elements;
  std::int64_t size = 0;   ///< bytes of the header; data starts after it
  std::int64_t lines = 0;  ///< lines of the header; data starts on the next line
};

/// Returns the header of a file.
/// @throws FormatError  a malformed header, or counts too large for the bytes after it; names file:line
PlyHeader parse_ply_header(std::string_view bytes, std::string_view name);

/// Returns a header as the lines of a file.
/// @param comments  lines of comments, each with its line end
std::string format_ply_header(const PlyHeader& header, const std::string& comments = "");

}  // namespace sublimit
