// SPDX-License-Identifier: Apache-2.0
#pragma once
// The data of a PLY file as a stream of rows and numbers, with the same interface for text and binary.
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/ply_header.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {

/// Text data, with a row per line.
class PlyTextValues {
 public:
  /// @param bytes  must outlive this
  template <TemporaryString Text>
  PlyTextValues(Text&& bytes, const PlyHeader&, std::string_view) = delete;
  PlyTextValues(std::string_view bytes, const PlyHeader& header, std::string_view name)
      : scanner_(bytes.substr(static_cast<std::size_t>(header.size)), name, TextScanner::Continuation::none),
        first_line_(header.lines) {}

  void begin_row() {
    if (!scanner_.next_filled_line()) fail("the data ends before the header's counts are met");
  }
  void end_row() {
    if (const std::string_view token = scanner_.token(); !token.empty()) {
      fail("unexpected " + in_quotes(token) + "; the header says that the line ends before it");
    }
  }
  /// Reads a number, which its type should hold: in other programs it would be another one.
  double real(PlyType type) {
    const double value = number<double>();
    const PlyRange range = range_of(type);
    if (std::isfinite(value) ? value < range.least || value > range.most : is_integer(type))
      fail("number " + format_number(value) + " is beyond the type " + range.name + " of the header; " +
           format_number(range.least) + " to " + format_number(range.most) + " are in it");
    return value;
  }
  /// Reads an index or the length of a list, which text has room for whatever the type.
  std::int64_t integer(PlyType) { return number<std::int64_t>(); }
  void skip(PlyType, std::int64_t count) {
    for (; count > 0; --count) {
      if (scanner_.token().empty()) fail("the line ends before the header's properties are met");
    }
  }
  bool at_end() { return !scanner_.next_filled_line(); }
  std::string place() const { return scanner_.place(first_line_ + scanner_.line()); }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw FormatError(place() + what); }

  template <class T>
  T number() {
    const std::string_view token = scanner_.token();
    const Parsed<T> parsed = parse_number<T>(token);
    if (parsed) return parsed.value;
    if (token.empty()) fail("the line ends before the header's properties are met");
    fail(parsed.status == ParseStatus::too_large ? "number " + in_quotes(token) + " is too large"
                                                 : in_quotes(token) + " is not a number of the type in the header");
  }

  TextScanner scanner_;
  std::int64_t first_line_;
};

/// Binary data of either byte order; rows have no separators.
class PlyBinaryValues {
 public:
  /// @param bytes  must outlive this
  template <TemporaryString Text>
  PlyBinaryValues(Text&& bytes, const PlyHeader&, std::string_view) = delete;
  PlyBinaryValues(std::string_view bytes, const PlyHeader& header, std::string_view name)
      : bytes_(bytes),
        name_(name),
        here_(static_cast<std::size_t>(header.size)),
        swapped_((header.encoding == PlyHeader::Encoding::big_endian) == (std::endian::native == std::endian::little)) {
  }

  /// Returns the position in the file, and moves there: to the beginning of a row.
  std::int64_t offset() const { return static_cast<std::int64_t>(here_); }
  void move_to(std::int64_t offset) { here_ = static_cast<std::size_t>(offset); }

  void begin_row() {}
  void end_row() {}
  double real(PlyType type) {
    switch (type) {
      case PlyType::float32:
        return std::bit_cast<float>(load<std::uint32_t>());
      case PlyType::float64:
        return std::bit_cast<double>(load<std::uint64_t>());
      default:
        return static_cast<double>(integer(type));
    }
  }
  /// @pre  `type` is an integer type
  std::int64_t integer(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return static_cast<std::int8_t>(load<std::uint8_t>());
      case PlyType::uint8:
        return load<std::uint8_t>();
      case PlyType::int16:
        return static_cast<std::int16_t>(load<std::uint16_t>());
      case PlyType::uint16:
        return load<std::uint16_t>();
      case PlyType::int32:
        return static_cast<std::int32_t>(load<std::uint32_t>());
      default:
        return load<std::uint32_t>();
    }
  }
  void skip(PlyType type, std::int64_t count) {
    require(count, byte_size(type));
    here_ += static_cast<std::size_t>(count * byte_size(type));
  }
  bool at_end() const { return here_ == bytes_.size(); }
  std::string place() const { return name_ + ": byte " + format_number(here_) + ": "; }

 private:
  void require(std::int64_t count, std::int64_t size) const {
    if (count <= static_cast<std::int64_t>(bytes_.size() - here_) / size) return;
    throw FormatError(place() + "the data ends before the header's counts are met");
  }

  template <class T>
  T load() {
    require(1, sizeof(T));
    T value;
    std::memcpy(&value, bytes_.data() + here_, sizeof(T));
    here_ += sizeof(T);
    if (!swapped_) return value;
    T reversed = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) reversed = static_cast<T>(reversed << 8 | (value >> 8 * i & 0xff));
    return reversed;
  }

  std::string_view bytes_;
  std::string name_;
  std::size_t here_;
  bool swapped_;
};

}  // namespace sublimit
