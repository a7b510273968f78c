// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/npy_records.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/mapped_file.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/formats/npy_header.h"

namespace sublimit {
namespace {

static_assert(std::endian::native == std::endian::little, "records are copied as they are in memory");

constexpr std::size_t letter = 4;  // bytes of a character of kind U

constexpr std::array<std::string_view, 6> whole_columns{"face", "patch", "curve", "segment", "ray", "point"};
/// Texts, and the letters that the longest one has.
constexpr std::array<std::pair<std::string_view, std::size_t>, 2> text_columns{{{"status", 17}, {"side", 2}}};

std::string_view next_field(std::string_view& line) {
  const std::size_t comma = line.find(',');
  const std::string_view field = line.substr(0, comma);
  line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  return field;
}

template <class T>
void append_bytes(std::string& out, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

void append_field(std::string& out, std::string_view text, const NpyField& field) {
  const auto fail = [&] { throw FormatError(field.name + " " + std::string(text) + " has no place in an .npy"); };
  if (field.kind == 'U') {
    if (text.size() * letter > field.size) fail();
    for (const char c : text) append_bytes(out, std::uint32_t(static_cast<unsigned char>(c)));
    out.append(field.size - text.size() * letter, '\0');
  } else if (field.kind == 'i') {
    const Parsed<std::int64_t> number = parse_number<std::int64_t>(text);
    if (!number && !text.empty()) fail();
    append_bytes(out, text.empty() ? std::int64_t{-1} : number.value);
  } else {
    const Parsed<double> number = parse_number<double>(text);
    if (!number && !text.empty()) fail();
    append_bytes(out, text.empty() ? std::numeric_limits<double>::quiet_NaN() : number.value);
  }
}

template <class T>
T value_at(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

void append_float(std::string& out, double value) {
  if (!std::isnan(value)) append_number(out, value);
}

void append_text(std::string& out, const std::byte* from, const NpyField& field) {
  const std::size_t step = field.kind == 'U' ? letter : 1;
  for (std::size_t i = 0; i < field.size; i += step) {
    const std::uint32_t code = step == 1 ? std::to_integer<std::uint32_t>(from[i]) : value_at<std::uint32_t>(from + i);
    if (code == 0) return;
    out += code < 128 && code != ',' ? static_cast<char>(code) : '?';  // our words have no others
  }
}

void append_value(std::string& out, const std::byte* from, const NpyField& field) {
  switch (field.kind) {
    case 'f':
      return append_float(out, field.size == 4 ? double(value_at<float>(from)) : value_at<double>(from));
    case 'i':
      return append_number(out, field.size == 1   ? value_at<std::int8_t>(from)
                                : field.size == 2 ? value_at<std::int16_t>(from)
                                : field.size == 4 ? value_at<std::int32_t>(from)
                                                  : value_at<std::int64_t>(from));
    case 'u':
    case 'b':
      return append_number(out, field.size == 1   ? value_at<std::uint8_t>(from)
                                : field.size == 2 ? value_at<std::uint16_t>(from)
                                : field.size == 4 ? value_at<std::uint32_t>(from)
                                                  : value_at<std::uint64_t>(from));
    default:
      return append_text(out, from, field);
  }
}

/// The field that a type describes, '<f8', '|S3'.
NpyField field_of(const std::string& name, const std::string& type, const std::string& file) {
  const auto fail = [&] {
    throw FormatError(file + ": " + (name.empty() ? "its items are" : "field '" + name + "' is") + " of type '" +
                      type.substr(0, 40) + "'; little-endian numbers ('<f8', '<i8') and texts ('<U9') are right");
  };
  if (type.size() < 3 || (type[0] != '<' && type[0] != '|') || !std::strchr("fiubUS", type[1])) fail();
  const auto count = parse_number<std::int64_t>(std::string_view(type).substr(2));
  if (!count || count.value < 0 || count.value > 1 << 16) fail();
  NpyField field{name, type[1], std::size_t(count.value) * (type[1] == 'U' ? letter : 1)};
  const bool is_text = field.kind == 'U' || field.kind == 'S';
  const bool is_size =
      field.size == 4 || field.size == 8 || (field.kind != 'f' && (field.size == 1 || field.size == 2));
  if (!is_text && !is_size) fail();
  return field;
}

}  // namespace

NpyField npy_field(std::string_view column) {
  const auto is_column = [&](const auto& row) { return row.first == column; };
  if (const auto text = std::ranges::find_if(text_columns, is_column); text != text_columns.end())
    return {std::string(column), 'U', text->second * letter};
  const bool whole = std::ranges::find(whole_columns, column) != whole_columns.end();
  return {std::string(column), whole ? 'i' : 'f', 8};
}

std::string npy_header(std::span<const NpyField> fields, std::int64_t records, std::size_t length) {
  std::string descr;
  for (const NpyField& field : fields)
    descr += (descr.empty() ? "[('" : ", ('") + field.name + "', '<" + field.kind +
             std::to_string(field.kind == 'U' ? field.size / letter : field.size) + "')";
  return format_npy_header(descr + "]", std::array{records}, length);
}

std::int64_t append_records(std::string& out, std::string_view lines, std::span<const NpyField> fields) {
  std::int64_t records = 0;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    std::string_view line = lines.substr(0, end);
    lines.remove_prefix(std::min(end + 1, lines.size()));
    if (std::size_t(std::ranges::count(line, ',')) + 1 != fields.size())
      throw FormatError("row " + std::string(line) + " has no " + std::to_string(fields.size()) + " fields");
    for (const NpyField& field : fields) append_field(out, next_field(line), field);
    ++records;
  }
  return records;
}

NpyRows::NpyRows(const std::filesystem::path& path) {
  MappedFile file = map_file(path);
  const std::string name = path.string();
  const auto fail = [&](const std::string& what) { throw FormatError(name + ": " + what); };
  const NpyHeader header = parse_npy_header(file.bytes, name);
  const bool are_records = !header.fields.empty();
  if (header.shape.size() != (are_records ? 1 : 2))
    fail("an array of " + std::to_string(header.shape.size()) + " dimensions; " +
         (are_records ? "records in one dimension" : "rows x columns") + " are right");
  if (header.fortran_order && !are_records)
    fail("its items are in Fortran order; C order is right: numpy.ascontiguousarray(a)");
  for (const auto& [field, type] : header.fields) fields_.push_back(field_of(field, type, name));
  constexpr std::int64_t most_columns = 4096;
  if (!are_records && header.shape[1] > most_columns) fail("more than " + std::to_string(most_columns) + " columns");
  for (std::int64_t i = 0; !are_records && i < header.shape[1]; ++i)
    fields_.push_back(field_of("", header.descr, name));
  for (const NpyField& field : fields_) {
    offsets_.push_back(record_);
    record_ += field.size;
  }
  num_rows_ = header.shape[0];
  bytes_ = file.bytes.subspan(header.bytes);
  owner_ = std::move(file.owner);
  std::int64_t expected = 0;
  if (__builtin_mul_overflow(num_rows_, std::int64_t(record_), &expected) || expected != std::int64_t(bytes_.size()))
    fail("its data has " + std::to_string(bytes_.size()) + " bytes, which " + std::to_string(num_rows_) + " rows of " +
         std::to_string(record_) + " bytes are not");
}

std::vector<std::string> NpyRows::columns() const {
  std::vector<std::string> names;
  for (const NpyField& field : fields_) names.push_back(field.name);
  return names;
}

void NpyRows::append_line(std::string& out, std::int64_t row, std::span<const std::size_t> columns) const {
  const std::byte* const record = bytes_.data() + std::size_t(row) * record_;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i > 0) out += ',';
    append_value(out, record + offsets_[columns[i]], fields_[columns[i]]);
  }
}

}  // namespace sublimit
