// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/npy_header.h"

#include <algorithm>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

constexpr std::string_view npy_magic = "\x93NUMPY";
constexpr size_t npy_alignment = 64, most_dimensions = 32;

/// The dictionary of a header: {'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }
class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  NpyHeader parse() {
    bool has_descr = false, has_order = false, has_shape = false;
    expect("{");
    while (!take("}")) {
      const std::string_view key = word();
      expect(":");
      if (key == "descr" && !std::exchange(has_descr, true)) {
        if (peek() == '[')
          header_.fields = fields();
        else
          header_.descr = word();
      } else if (key == "fortran_order" && !std::exchange(has_order, true)) {
        header_.fortran_order = take("True");
        if (!header_.fortran_order) expect("False");
      } else if (key == "shape" && !std::exchange(has_shape, true)) {
        header_.shape = dimensions();
      } else {
        fail("'" + std::string(key.substr(0, 40)) + "' is twice there, or should not be");
      }
      if (!take(",") && peek() != '}') fail("no ',' after '" + std::string(key) + "'");
    }
    skip();
    if (!rest_.empty()) fail("something after '}'");
    if (!has_order || !has_shape || (header_.descr.empty() && header_.fields.empty()))
      fail("descr, fortran_order and shape must be there");
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw FormatError(name_ + ": header of .npy: " + what); }
  void skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\n"), rest_.size())); }
  char peek() {
    skip();
    return rest_.empty() ? '\0' : rest_.front();
  }
  bool take(std::string_view text) {
    skip();
    if (!rest_.starts_with(text)) return false;
    rest_.remove_prefix(text.size());
    return true;
  }
  void expect(std::string_view text) {
    if (!take(text)) fail("no '" + std::string(text) + "' where it should be");
  }
  std::string_view word() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') fail("a name in quotes should be there");
    const size_t end = rest_.find(quote, 1);
    if (end == std::string_view::npos) fail("a quote that does not end");
    const std::string_view text = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    return text;
  }
  std::vector<std::int64_t> dimensions() {
    std::vector<std::int64_t> list;
    expect("(");
    while (!take(")")) {
      skip();
      const size_t end = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
      const Parsed<std::int64_t> number = parse_number<std::int64_t>(rest_.substr(0, end));
      if (!number || list.size() == most_dimensions) fail("a shape that no array has");
      list.push_back(number.value);
      rest_.remove_prefix(end);
      if (!take(",") && peek() != ')') fail("a shape that does not end");
    }
    return list;
  }
  /// [('face', '<i8'), ('x', '<f8')]
  std::vector<std::pair<std::string, std::string>> fields() {
    std::vector<std::pair<std::string, std::string>> list;
    expect("[");
    while (!take("]")) {
      expect("(");
      const std::string field(word());
      expect(",");
      if (peek() != '\'' && peek() != '"') fail("field '" + field + "' is a record; plain numbers and texts are right");
      list.emplace_back(field, word());
      take(",");
      if (!take(")")) fail("field '" + field + "' is an array; plain numbers and texts are right");
      if (!take(",") && peek() != ']') fail("a list of fields that does not end");
    }
    if (list.empty()) fail("its records have no fields");
    return list;
  }

  NpyHeader header_;
  std::string_view rest_;
  const std::string& name_;
};

}  // namespace

NpyHeader parse_npy_header(std::span<const std::byte> bytes, const std::string& name) {
  const auto fail = [&](const std::string& what) { throw FormatError(name + ": " + what); };
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!text.starts_with(npy_magic) || text.size() < 10) fail("not a .npy file: it does not begin with \\x93NUMPY");
  const int version = std::to_integer<int>(bytes[6]);
  if (version < 1 || version > 3) fail("version " + std::to_string(version) + " of .npy; 1 to 3 are known");
  const size_t begin = version == 1 ? 10 : 12;
  size_t length = 0;
  for (size_t i = begin; i-- > 8;) length = length << 8 | (i < text.size() ? std::to_integer<size_t>(bytes[i]) : 0);
  if (text.size() < begin || length > text.size() - begin)
    fail("its header should have " + std::to_string(length) + " bytes; the file is shorter");
  NpyHeader header = HeaderParser(text.substr(begin, length), name).parse();
  header.bytes = begin + length;
  return header;
}

std::string format_npy_header(std::string_view descr, std::span<const std::int64_t> shape, std::size_t length) {
  std::string text = "{'descr': " + std::string(descr) + ", 'fortran_order': False, 'shape': (";
  for (const std::int64_t n : shape) text += std::to_string(n) + ", ";
  if (shape.size() > 1) text.resize(text.size() - 2);
  if (shape.size() == 1) text.resize(text.size() - 1);
  text += "), }";
  const size_t before = npy_magic.size() + 4;
  const size_t least = (before + text.size() + 1 + npy_alignment - 1) / npy_alignment * npy_alignment;
  text.resize(std::max(least, length) - before - 1, ' ');
  text += '\n';
  if (text.size() >= 1 << 16) throw InvalidParameter("too many columns for one .npy file");
  std::string header(npy_magic);
  header += '\1';
  header += '\0';
  header += static_cast<char>(text.size() & 255);
  header += static_cast<char>(text.size() >> 8);
  return header + text;
}

}  // namespace sublimit
