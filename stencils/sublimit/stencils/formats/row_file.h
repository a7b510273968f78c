// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows below a header, as the name of the file wants them: a CSV, or an .npy of records with the same columns.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/row_writer.h"
#include "sublimit/stencils/formats/npy_records.h"

namespace sublimit {

/// A file of rows that are written as lines of a CSV. It appears whole or not at all.
class RowFile {
 public:
  /// @param header  first line of the CSV, with its end: names of columns
  RowFile(const std::filesystem::path& path, std::string_view header);

  /// Writes lines, each with its end.
  void write(std::string_view lines);
  /// Writes rows 0 to `count`, as `RowWriter::rows` does: append(text, begin, end) appends lines of rows.
  template <class Append>
  void rows(std::int64_t count, std::int64_t rows_per_block, const Append& append) {
    if (fields_.empty()) return RowWriter(file_).rows(count, rows_per_block, append);
    RowWriter(file_).rows(count, rows_per_block, [&](std::string& records, std::int64_t begin, std::int64_t end) {
      std::string lines;
      append(lines, begin, end);
      append_records(records, lines, fields_);
    });
    num_records_ += count;
  }
  /// Writes what is left; the file appears under its name.
  void commit();
  /// Returns true if the reader of standard output has closed it.
  bool is_dropped() const { return file_.is_dropped(); }

 private:
  std::vector<NpyField> fields_;  // of an .npy
  std::size_t header_bytes_ = 0;
  std::int64_t num_records_ = 0;
  AtomicFile file_;
};

}  // namespace sublimit
