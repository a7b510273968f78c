// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/ply_header.h"

#include <algorithm>
#include <limits>
#include <unordered_set>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

constexpr std::pair<std::string_view, PlyType> type_names[] = {
    {"char", PlyType::int8},       {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},     {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},     {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64},
};

/// By encoding.
constexpr std::string_view format_names[] = {"ascii", "binary_little_endian", "binary_big_endian"};

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, std::string_view name)
      : bytes_(bytes), scanner_(bytes, name, TextScanner::Continuation::none) {}

  PlyHeader parse() {
    scanner_.next_line();
    if (bytes_.empty()) throw FormatError(scanner_.name() + ": the file is empty; a PLY mesh is expected");
    if (const std::string_view magic = scanner_.token(); magic != "ply") {
      fail("the file starts with " + in_quotes(magic) + "; a PLY file starts with 'ply'");
    }
    for (;;) {
      if (!scanner_.next_line()) fail("the header has no 'end_header'");
      const std::string_view keyword = scanner_.token();
      if (keyword == "end_header") break;
      if (keyword == "format") {
        read_format();
      } else if (keyword == "element") {
        read_element();
      } else if (keyword == "property") {
        read_property();
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        fail("unknown keyword " + in_quotes(keyword) +
             " in the header; it may have format, comment, obj_info, element, property and end_header");
      }
    }
    if (!has_format_) fail("the header has no 'format' line; 'format ascii 1.0' is an example");
    finish();
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw FormatError(scanner_.place() + what); }

  void end_line() {
    if (const std::string_view token = scanner_.token(); !token.empty()) fail("unexpected " + in_quotes(token));
  }

  void read_format() {
    const std::string_view name = scanner_.token();
    const auto found = std::ranges::find(format_names, name);
    if (found == std::end(format_names))
      fail("unknown format " + in_quotes(name) + "; it should be ascii, binary_little_endian or binary_big_endian");
    header_.encoding = static_cast<PlyHeader::Encoding>(found - format_names);
    if (const std::string_view version = scanner_.token(); version != "1.0") {
      fail("unknown version " + in_quotes(version) + "; 1.0 can be read");
    }
    end_line();
    has_format_ = true;
  }

  void read_element() {
    PlyElement element{.name = std::string(scanner_.token()), .count = 0, .properties = {}, .line = scanner_.line()};
    if (element.name.empty()) fail("an element without a name; it should be 'element NAME COUNT'");
    element.count = scanner_.integer(scanner_.token(), "number of elements");
    if (element.count < 0) fail("number of elements is negative");
    if (!names_.insert(element.name).second) fail("a second element " + in_quotes(element.name));
    end_line();
    header_.elements.push_back(std::move(element));
  }

  PlyType type(std::string_view token) const {
    for (const auto& [name, type] : type_names) {
      if (token == name) return type;
    }
    fail("unknown type " + in_quotes(token) + "; types are char, uchar, short, ushort, int, uint, float and double");
  }

  void read_property() {
    if (header_.elements.empty()) fail("a property before the first element");
    PlyProperty property{};
    std::string_view token = scanner_.token();
    if (token == "list") {
      property.length = type(scanner_.token());
      if (!is_integer(*property.length)) fail("the length of a list should have an integer type");
      token = scanner_.token();
    }
    property.type = type(token);
    property.name = scanner_.token();
    if (property.name.empty()) fail("a property without a name; it should be 'property TYPE NAME'");
    property.line = scanner_.line();
    end_line();
    header_.elements.back().properties.push_back(std::move(property));
  }

  void finish() {
    // Data starts right behind the line end of end_header, which may be another one than those of the lines above. A
    // line feed behind a carriage return is data only where lines end in a carriage return alone.
    end_line();
    auto size = static_cast<std::size_t>(scanner_.offset());
    const std::size_t first_end = bytes_.find_first_of("\r\n");
    const bool cr_alone = bytes_[first_end] == '\r' && bytes_.substr(first_end, 2) != "\r\n";
    if (size < bytes_.size()) size += !cr_alone && bytes_.substr(size, 2) == "\r\n" ? 2 : 1;
    header_.size = static_cast<std::int64_t>(size);
    header_.lines = scanner_.line();

    const std::int64_t rest = static_cast<std::int64_t>(bytes_.size()) - header_.size;
    for (const PlyElement& element : header_.elements) {
      std::int64_t row = 0;  // bytes of the shortest row
      for (const PlyProperty& property : element.properties) {
        const bool text = header_.encoding == PlyHeader::Encoding::text;
        row += text ? 2 : byte_size(property.length.value_or(property.type));  // text: a digit and what parts it
      }
      if (row == 0 || element.count <= (rest + 1) / row) continue;
      throw FormatError(scanner_.place(element.line) + format_number(element.count) + " elements " +
                        in_quotes(element.name) + " cannot be in the " + format_number(rest) +
                        " bytes that follow the header");
    }
  }

  std::string_view bytes_;
  TextScanner scanner_;
  PlyHeader header_;
  std::unordered_set<std::string> names_;  // of elements
  bool has_format_ = false;
};

template <class T>
PlyRange range_of(const char* name) {
  return {name, double(std::numeric_limits<T>::lowest()), double(std::numeric_limits<T>::max())};
}

}  // namespace

PlyRange range_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
      return range_of<std::int8_t>("char");
    case PlyType::uint8:
      return range_of<std::uint8_t>("uchar");
    case PlyType::int16:
      return range_of<std::int16_t>("short");
    case PlyType::uint16:
      return range_of<std::uint16_t>("ushort");
    case PlyType::int32:
      return range_of<std::int32_t>("int");
    case PlyType::uint32:
      return range_of<std::uint32_t>("uint");
    case PlyType::float32:
      return range_of<float>("float");
    case PlyType::float64:
      break;
  }
  return range_of<double>("double");
}

std::int64_t byte_size(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      return 8;
  }
  return 0;
}

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

std::optional<std::int64_t> row_size(const PlyElement& element) {
  std::int64_t size = 0;
  for (const PlyProperty& property : element.properties) {
    if (property.length) return std::nullopt;
    size += byte_size(property.type);
  }
  return size;
}

PlyHeader parse_ply_header(std::string_view bytes, std::string_view name) { return HeaderParser(bytes, name).parse(); }

std::string format_ply_header(const PlyHeader& header, const std::string& comments) {
  const auto word = [](PlyType type) {
    return std::string(std::ranges::find(type_names, type, &std::pair<std::string_view, PlyType>::second)->first) + " ";
  };
  std::string out = "ply\nformat " + std::string(format_names[static_cast<std::size_t>(header.encoding)]) + " 1.0\n";
  out += comments;
  for (const PlyElement& element : header.elements) {
    out += "element " + element.name + " " + format_number(element.count) + "\n";
    for (const PlyProperty& property : element.properties)
      out += "property " + (property.length ? "list " + word(*property.length) : "") + word(property.type) +
             property.name + "\n";
  }
  return out + "end_header\n";
}

}  // namespace sublimit
