// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of a CSV with a known header, one at a time: a file of any length takes the memory of one block.
//
// Lines end with LF or CRLF; blanks around a field and empty lines at the end are left out. The byte order mark that
// spreadsheets write is skipped. An .npy has the same rows: records with fields of these names, others are left out, or
// an array of rows x columns. Not-a-number is an empty field.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/stencils/formats/npy_records.h"

namespace sublimit {

class CsvRows {
 public:
  /// Opens a file.
  /// @param columns  header, which must be the first line
  /// @throws IoError  missing, unreadable;  FormatError  no header or another one
  CsvRows(const std::filesystem::path& path, std::vector<std::string> columns);
  /// Opens a file with one of several headers; `columns()` returns which one.
  /// @param right  all headers in words, for messages: `face,u,v or segment,t`
  CsvRows(const std::filesystem::path& path, std::vector<std::vector<std::string>> headers, const std::string& right);
  CsvRows(const CsvRows&) = delete;
  CsvRows& operator=(const CsvRows&) = delete;
  ~CsvRows();

  /// Moves to the next row; false at the end.
  /// @throws FormatError  another number of fields than the header has, an empty line between rows;  IoError
  bool next();

  /// Returns a field of this row as a whole number.
  /// @param valid  range of valid numbers, for the message: `faces are 0 to 5`
  /// @throws FormatError  not a whole number
  std::int64_t integer(size_t column, std::string_view valid) const;
  /// @throws FormatError  not a number, or not a finite one
  double finite(size_t column) const;

  const std::vector<std::string>& columns() const { return columns_; }
  std::string_view text(size_t column) const { return fields_[column]; }
  bool is_empty(size_t column) const { return fields_[column].empty(); }
  /// Returns the line of this row, from 1.
  std::int64_t line() const { return line_; }
  /// Returns "NAME:LINE: " of this row, "NAME[INDEX]: " of an .npy.
  std::string place() const;

 private:
  void open_array(const std::vector<std::vector<std::string>>& headers, const std::string& right);
  bool next_line(std::string_view& line);
  std::string place(std::int64_t line) const;
  std::string header() const;

  std::filesystem::path path_;
  std::vector<std::string> columns_;
  std::vector<std::string_view> fields_;
  std::optional<NpyRows> array_;
  std::vector<size_t> taken_;  // columns of the array
  std::string array_line_;
  int file_ = -1;
  std::vector<char> block_;
  size_t begin_ = 0, end_ = 0;  // text that was read and not yet returned
  std::int64_t line_ = 0;
};

}  // namespace sublimit
