// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of named columns as arrays of NumPy: an .npy of records, whose fields are the columns, `a["face"]`, `a["x"]`.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sublimit {

/// A field of a record, little-endian.
struct NpyField {
  std::string name;
  char kind = 'f';       ///< 'f' number, 'i' and 'u' whole number, 'b' truth value, 'U' text, 'S' text of bytes
  std::size_t size = 8;  ///< bytes
};

/// Returns the field of a column by its name: numbers of faces, curves and rays are int64, status and side texts, all
/// others float64.
NpyField npy_field(std::string_view column);

/// Returns the header of an .npy file of records.
/// @param length  bytes that it should have; 0: as few as it can
std::string npy_header(std::span<const NpyField> fields, std::int64_t records, std::size_t length = 0);

/// Appends lines of a CSV as records: the same bits, not-a-number for an empty number, -1 for an empty whole number.
/// @return  number of records
/// @throws FormatError  a line with another number of fields, or a field that its type has no room for
std::int64_t append_records(std::string& out, std::string_view lines, std::span<const NpyField> fields);

/// Rows of an .npy: records, or an array of rows x columns of numbers.
class NpyRows {
 public:
  /// @throws IoError      missing, unreadable
  /// @throws FormatError  not an .npy file of rows; a damaged one
  explicit NpyRows(const std::filesystem::path& path);

  /// Returns the number of rows.
  std::int64_t num_rows() const { return num_rows_; }
  /// Returns the names of columns; empty texts if the file names none.
  std::vector<std::string> columns() const;
  /// Appends a row as a line of a CSV without its end: numbers in the shortest form, nothing for not-a-number.
  /// @param columns  columns to take, in this order
  void append_line(std::string& out, std::int64_t row, std::span<const std::size_t> columns) const;

 private:
  std::shared_ptr<const void> owner_;
  std::span<const std::byte> bytes_;
  std::vector<NpyField> fields_;
  std::vector<std::size_t> offsets_;  // of fields in a record
  std::size_t record_ = 0;            // bytes
  std::int64_t num_rows_ = 0;
};

}  // namespace sublimit
