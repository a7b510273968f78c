// SPDX-License-Identifier: Apache-2.0
#pragma once
// The header of a PLY file: which elements follow, how many of each, and what a row of each is made of.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sublimit {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::int64_t byte_size(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type;                   ///< of the value, or of each value of a list
  std::optional<PlyType> length;  ///< lists: type of the number of values, which stands in front of them
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
  std::int64_t line = 0;
};

struct PlyHeader {
  enum class Encoding { text, little_endian, big_endian };
  Encoding encoding = Encoding::text;
  std::vector<PlyElement> elements;
  std::int64_t size = 0;   ///< bytes; data starts behind
  std::int64_t lines = 0;  ///< data starts on the line behind
};

/// @throws FormatError  with file:line; among others for counts that the bytes behind the header cannot hold
PlyHeader parse_ply_header(std::string_view bytes, std::string_view name);

}  // namespace sublimit
