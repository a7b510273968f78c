// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <filesystem>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/fit_jobs/fit_job.h"
#include "sublimit/stencils/formats/csv_rows.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit {
namespace {

/// Throws what is wrong with a vertex, if anything is.
void check(std::vector<bool>& pinned, std::int64_t v, const std::function<void(const std::string&)>& refuse) {
  if (v < 0 || v >= std::ssize(pinned))
    refuse("vertex " + format_number(v) + " does not exist; vertices are 0 to " + format_number(pinned.size() - 1));
  if (pinned[size_t(v)]) refuse("vertex " + format_number(v) + " is pinned twice; name it once");
  pinned[size_t(v)] = true;
}

Pins from_list(const std::string& text, std::vector<bool>& pinned) {
  Pins pins;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const Parsed<std::int64_t> v = parse_number<std::int64_t>(std::string_view(text).substr(begin, end - begin));
    const auto refuse = [&](const std::string& what) { throw InvalidOption("--pin " + text + ": " + what); };
    if (!v) refuse("it should be a list of vertices, as 3,7, or a CSV with the header vertex or vertex,x,y,z");
    check(pinned, v.value, refuse);
    pins.vertices.push_back(static_cast<Index>(v.value));
    begin = end + 1;
  }
  return pins;
}

Pins from_file(const std::string& path, std::vector<bool>& pinned) {
  CsvRows rows(path, {{"vertex"}, {"vertex", "x", "y", "z"}}, "vertex[,x,y,z]");
  Pins pins;
  std::vector<double> values;
  while (rows.next()) {
    const std::int64_t v = rows.integer(0, "vertices are counted from 0");
    check(pinned, v, [&](const std::string& what) { throw FormatError(rows.place() + what); });
    pins.vertices.push_back(static_cast<Index>(v));
    for (size_t c = 1; c < rows.columns().size(); ++c) values.push_back(rows.finite(c));
  }
  if (!values.empty())
    pins.values = Eigen::Map<const Points>(values.data(), static_cast<Index>(pins.vertices.size()), 3);
  return pins;
}

}  // namespace

Pins read_pins(const std::string& text, Index num_vertices) {
  std::vector<bool> pinned(size_t(num_vertices), false);
  const bool list = std::all_of(text.begin(), text.end(),
                                [](unsigned char c) { return std::isdigit(c) || c == ',' || c == '-' || c == ' '; });
  if (list) return from_list(text, pinned);
  std::error_code ignored;
  const bool is_file = all_formats().reads(text, contents::rows) || all_formats().reads(text, contents::arrays);
  if (!is_file && !std::filesystem::exists(opened_path(text), ignored))
    throw InvalidOption("--pin " + text + ": neither a list of vertices, as 3,7, nor a file");
  return from_file(text, pinned);
}

}  // namespace sublimit
