// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/npy.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/mapped_file.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

constexpr std::string_view magic = "\x93NUMPY";
constexpr size_t alignment = 64, most_dimensions = 32;

const char* description(DType type) {
  switch (type) {
    case DType::F64:
      return "<f8";
    case DType::I64:
      return "<i8";
    case DType::F32:
      return "<f4";
    case DType::I32:
      return "<i4";
    case DType::U8:
      break;
  }
  return "|u1";
}

/// The dictionary of a header: {'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }
class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  std::string descr;
  std::optional<bool> fortran_order;
  std::optional<std::vector<std::int64_t>> shape;

  void parse() {
    expect("{");
    while (!take("}")) {
      const std::string_view key = word();
      expect(":");
      if (key == "descr" && descr.empty()) {
        if (peek() != '\'' && peek() != '"') fail("its items are records; plain numbers are right");
        descr = word();
      } else if (key == "fortran_order" && !fortran_order) {
        fortran_order = take("True");
        if (!*fortran_order) expect("False");
      } else if (key == "shape" && !shape) {
        shape = dimensions();
      } else {
        fail("'" + std::string(key.substr(0, 40)) + "' is twice there, or should not be");
      }
      if (!take(",") && peek() != '}') fail("no ',' after '" + std::string(key) + "'");
    }
    skip();
    if (!rest_.empty()) fail("something after '}'");
    if (descr.empty() || !fortran_order || !shape) fail("descr, fortran_order and shape must be there");
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
  std::string_view rest_;
  const std::string& name_;
};

std::int64_t num_items(std::span<const std::int64_t> shape) {
  std::int64_t items = 1;
  for (const std::int64_t n : shape) items *= n;
  return items;
}

}  // namespace

std::string npy_header(DType type, std::span<const std::int64_t> shape) {
  std::string text = std::string("{'descr': '") + description(type) + "', 'fortran_order': False, 'shape': (";
  for (const std::int64_t n : shape) text += std::to_string(n) + ", ";
  if (shape.size() > 1) text.resize(text.size() - 2);
  if (shape.size() == 1) text.resize(text.size() - 1);
  text += "), }";
  text.resize((magic.size() + 4 + text.size() + 1 + alignment - 1) / alignment * alignment - magic.size() - 4 - 1, ' ');
  text += '\n';
  std::string header(magic);
  header += '\1';
  header += '\0';
  header += static_cast<char>(text.size() & 255);
  header += static_cast<char>(text.size() >> 8);
  return header + text;
}

NpyArray::NpyArray(const std::filesystem::path& path) {
  MappedFile file = map_file(path);
  bytes_ = file.bytes;
  owner_ = std::move(file.owner);
  parse(path.string());
}

NpyArray::NpyArray(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes) { parse(name); }

void NpyArray::parse(const std::string& name) {
  const auto fail = [&](const std::string& what) { throw FormatError(name + ": " + what); };
  const std::string_view text(reinterpret_cast<const char*>(bytes_.data()), bytes_.size());
  if (!text.starts_with(magic) || text.size() < 10) fail("not a .npy file: it does not begin with \\x93NUMPY");
  const int version = std::to_integer<int>(bytes_[6]);
  if (version < 1 || version > 3) fail("version " + std::to_string(version) + " of .npy; 1 to 3 are known");
  const size_t begin = version == 1 ? 10 : 12;
  size_t length = 0;
  for (size_t i = begin; i-- > 8;) length = length << 8 | (i < text.size() ? std::to_integer<size_t>(bytes_[i]) : 0);
  if (text.size() < begin || length > text.size() - begin)
    fail("its header should have " + std::to_string(length) + " bytes; the file is shorter");
  HeaderParser header(text.substr(begin, length), name);
  header.parse();
  if (header.descr != "<f4" && header.descr != "<f8")
    fail("its items are '" + header.descr.substr(0, 40) +
         "'; little-endian '<f4' and '<f8' are right: a.astype('<f8')");
  if (*header.fortran_order && header.shape->size() > 1)
    fail("its items are in Fortran order; C order is right: numpy.ascontiguousarray(a)");
  dtype_ = header.descr == "<f4" ? DType::F32 : DType::F64;
  shape_ = std::move(*header.shape);
  std::int64_t expected = item_size(dtype_);
  bool too_large = false;
  for (const std::int64_t n : shape_) too_large = __builtin_mul_overflow(expected, n, &expected) || too_large;
  // A dimension of 0 makes an overflow before it harmless for the bytes, but nobody means such an array.
  bytes_ = bytes_.subspan(begin + length);
  if (too_large || expected != std::int64_t(bytes_.size()))
    fail("its data has " + std::to_string(bytes_.size()) + " bytes, " +
         (too_large ? "its shape more than any file" : "its shape " + std::to_string(expected)));
  size_ = expected / item_size(dtype_);
}

template <class Real>
void NpyArray::read(std::int64_t first, std::span<Real> out) const {
  if (first < 0 || first > size_ || std::int64_t(out.size()) > size_ - first)
    throw InvalidParameter(".npy: items " + std::to_string(first) + " to " +
                           std::to_string(first + std::int64_t(out.size())) + " of " + std::to_string(size_));
  const auto copy = [&]<class Item>() {
    const std::byte* from = bytes_.data() + first * std::int64_t(sizeof(Item));
    if constexpr (std::is_same_v<Item, Real>) {
      if (!out.empty()) std::memcpy(out.data(), from, out.size_bytes());
    } else {
      for (Real& number : out) {  // of any alignment
        Item item;
        std::memcpy(&item, from, sizeof(Item));
        number = static_cast<Real>(item);
        from += sizeof(Item);
      }
    }
  };
  if (dtype_ == DType::F32) return copy.template operator()<float>();
  copy.template operator()<double>();
}

template void NpyArray::read(std::int64_t, std::span<float>) const;
template void NpyArray::read(std::int64_t, std::span<double>) const;

NpyWriter::NpyWriter(const std::filesystem::path& path, DType type, std::vector<std::int64_t> shape)
    : file_(path), type_(type), left_(num_items(shape) * item_size(type)) {
  file_.write(npy_header(type, shape));
}

void NpyWriter::write_bytes(DType type, std::span<const std::byte> bytes) {
  if (type != type_ || std::int64_t(bytes.size()) > left_)
    throw InvalidParameter(std::string(".npy: ") + std::to_string(bytes.size()) + " bytes of " + name(type) +
                           ", where " + std::to_string(left_) + " of " + name(type_) + " are left");
  left_ -= std::int64_t(bytes.size());
  file_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void NpyWriter::commit() {
  if (left_ != 0) throw InvalidParameter(".npy: " + std::to_string(left_) + " bytes have not been written");
  file_.commit();
}

}  // namespace sublimit
