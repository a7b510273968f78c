// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/row_file.h"

#include <algorithm>
#include <limits>

#include "sublimit/stencils/formats/formats.h"

namespace sublimit {
namespace {

bool is_array(const std::filesystem::path& path) { return all_formats().writes(path, contents::arrays); }

}  // namespace

RowFile::RowFile(const std::filesystem::path& path, std::string_view header)
    : file_(path, {}, is_array(path) ? AtomicFile::Access::anywhere : AtomicFile::Access::at_end) {
  if (!is_array(path)) {
    file_.write(header);
    return;
  }
  while (!header.empty()) {
    const std::size_t end = std::min(header.find_first_of(",\n"), header.size());
    fields_.push_back(npy_field(header.substr(0, end)));
    header.remove_prefix(std::min(end + 1, header.size()));
  }
  // The number of rows is known at the end: there is room for any.
  const std::string longest = npy_header(fields_, std::numeric_limits<std::int64_t>::max());
  header_bytes_ = longest.size();
  file_.write(longest);
}

void RowFile::write(std::string_view lines) {
  if (fields_.empty()) return file_.write(lines);
  std::string records;
  num_records_ += append_records(records, lines, fields_);
  file_.write(records);
}

void RowFile::commit() {
  if (!fields_.empty()) file_.rewrite(0, npy_header(fields_, num_records_, header_bytes_));
  file_.commit();
}

}  // namespace sublimit
