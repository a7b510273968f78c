// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/csv_rows.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "sublimit/base/detail/file_error.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit {
namespace {

constexpr size_t block_bytes = size_t{1} << 20;
constexpr size_t longest_line = size_t{1} << 16;

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

std::string joined(const std::vector<std::string>& columns) {
  std::string names;
  for (const std::string& column : columns) names += (names.empty() ? "" : ",") + column;
  return names;
}

}  // namespace

CsvRows::CsvRows(const std::filesystem::path& path, std::vector<std::string> columns)
    : CsvRows(path, {columns}, joined(columns)) {}

CsvRows::CsvRows(const std::filesystem::path& path, std::vector<std::vector<std::string>> headers,
                 const std::string& right)
    : path_(path) {
  if (all_formats().reads(path, contents::arrays)) {
    open_array(headers, right);
    return;
  }
  block_.resize(block_bytes);
  file_ = ::open(opened_path(path).c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) throw_file_error(path, "read", errno);
  try {
    std::string_view line;
    if (!next_line(line)) throw FormatError(path.string() + ": empty; its first line should be the header " + right);
    if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    split(line, fields_);
    const auto found = std::ranges::find_if(
        headers, [this](const std::vector<std::string>& columns) { return std::ranges::equal(columns, fields_); });
    if (found == headers.end())
      throw FormatError(place() + "the first line is " + in_quotes(line) + "; it should be the header " + right);
    columns_ = std::move(*found);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

void CsvRows::open_array(const std::vector<std::vector<std::string>>& headers, const std::string& right) {
  array_.emplace(path_);
  const std::vector<std::string> names = array_->columns();
  const bool is_named = std::ranges::any_of(names, [](const std::string& name) { return !name.empty(); });
  std::vector<size_t> taken;
  for (const std::vector<std::string>& columns : headers) {  // the longest that it has: more of them are optional
    taken.clear();
    for (size_t i = 0; i < columns.size(); ++i) {
      const auto found = std::ranges::find(names, columns[i]);
      if (!is_named || found != names.end()) taken.push_back(is_named ? size_t(found - names.begin()) : i);
    }
    if (taken.size() != columns.size() || columns.size() <= columns_.size()) continue;
    if (!is_named && columns.size() != names.size()) continue;
    columns_ = columns;
    taken_ = taken;
  }
  if (columns_.empty())
    throw FormatError(path_.string() + ": " +
                      (is_named ? "its fields are " + joined(names)
                                : "an array of " + format_number(std::ssize(names)) + " columns") +
                      "; the columns should be " + right);
}

CsvRows::~CsvRows() {
  if (file_ >= 0) ::close(file_);
}

std::string CsvRows::header() const { return joined(columns_); }

std::string CsvRows::place(std::int64_t line) const {
  return path_.string() + (array_ ? "[" + format_number(line - 1) + "]: " : ":" + format_number(line) + ": ");
}
std::string CsvRows::place() const { return place(line_); }

bool CsvRows::next_line(std::string_view& line) {
  if (array_) {
    if (line_ == array_->num_rows()) return false;
    array_line_.clear();
    array_->append_line(array_line_, line_++, taken_);
    line = array_line_;
    return true;
  }
  size_t searched = 0;
  for (;;) {
    const char* const start = block_.data() + begin_;
    if (const void* found = std::memchr(start + searched, '\n', end_ - begin_ - searched)) {
      line = {start, size_t(static_cast<const char*>(found) - start)};
      begin_ += line.size() + 1;
      break;
    }
    searched = end_ - begin_;
    if (searched > longest_line)
      throw FormatError(place(line_ + 1) + "no end of the line within " + format_number(longest_line) +
                        " bytes; a row should be " + header());
    if (end_ == block_.size()) {
      std::memmove(block_.data(), start, searched);
      begin_ = 0;
      end_ = searched;
    }
    const ssize_t got = ::read(file_, block_.data() + end_, block_.size() - end_);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw_file_error(path_, "read", errno, errno == EISDIR ? "name a file in it" : "");
    if (got == 0) {
      if (searched == 0) return false;
      line = {block_.data() + begin_, searched};
      begin_ = end_;
      break;
    }
    end_ += size_t(got);
  }
  if (line.ends_with('\r')) line.remove_suffix(1);
  ++line_;
  return true;
}

bool CsvRows::next() {
  std::int64_t empty = 0;  // the first of these lines
  for (std::string_view line; next_line(line);) {
    if (trimmed(line).empty()) {
      if (empty == 0) empty = line_;
      continue;
    }
    if (empty != 0)
      throw FormatError(place(empty) + "an empty line, and rows after it; every line should be " + header());
    split(line, fields_);
    if (fields_.size() != columns_.size())
      throw FormatError(place() + format_number(fields_.size()) + (fields_.size() == 1 ? " field" : " fields") +
                        ", not " + format_number(columns_.size()) + "; a row should be " + header());
    return true;
  }
  return false;
}

std::int64_t CsvRows::integer(size_t column, std::string_view valid) const {
  const Parsed<std::int64_t> parsed = parse_number<std::int64_t>(fields_[column]);
  if (parsed) return parsed.value;
  const std::string what = place() + columns_[column];
  if (fields_[column].empty()) throw FormatError(what + " is missing; " + std::string(valid));
  throw FormatError(what + " " + in_quotes(fields_[column]) +
                    (parsed.status == ParseStatus::too_large ? " does not exist; " : " is not a whole number; ") +
                    std::string(valid));
}

double CsvRows::finite(size_t column) const {
  const Parsed<double> parsed = parse_number<double>(fields_[column]);
  if (parsed && std::isfinite(parsed.value)) return parsed.value;
  const std::string what = place() + columns_[column];
  if (fields_[column].empty()) throw FormatError(what + " is missing; it should be a decimal number");
  if (parsed || parsed.status == ParseStatus::too_large)
    throw FormatError(what + " is " + in_quotes(fields_[column]) + "; it should be a finite number");
  throw FormatError(what + " " + in_quotes(fields_[column]) + " is not a number; it should be a decimal number");
}

}  // namespace sublimit
