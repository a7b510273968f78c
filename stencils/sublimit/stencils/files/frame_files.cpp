// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/frame_files.h"

#include <algorithm>
#include <system_error>

#include "sublimit/base/detail/file_error.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {

std::optional<FramePattern> FramePattern::find(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  const std::size_t first = name.find('#');
  std::error_code ignored;
  if (first == std::string::npos || std::filesystem::exists(path, ignored)) return std::nullopt;
  const std::size_t end = std::min(name.find_first_not_of('#', first), name.size());
  if (name.find('#', end) != std::string::npos)
    throw InvalidOption(path.string() + ": # in two places; one of them stands for the number of the frame");
  return FramePattern(path.parent_path(), name.substr(0, first), end - first, name.substr(end));
}

std::filesystem::path FramePattern::file(std::int64_t frame) const {
  std::string number = format_number(frame);
  if (number.size() < digits_) number.insert(0, digits_ - number.size(), '0');
  return directory_ / (before_ + number + behind_);
}

std::vector<std::int64_t> FramePattern::frames() const {
  std::vector<std::int64_t> numbers;
  const std::filesystem::path directory = directory_.empty() ? "." : directory_;
  std::error_code failed;
  std::filesystem::directory_iterator entry(directory, failed);
  for (; !failed && entry != std::filesystem::directory_iterator(); entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    if (name.size() < before_.size() + digits_ + behind_.size() || !name.starts_with(before_) ||
        !name.ends_with(behind_))
      continue;
    const std::string number = name.substr(before_.size(), name.size() - before_.size() - behind_.size());
    const bool is_padded = number.size() == digits_ || number[0] != '0';
    const bool has_digits = number.find_first_not_of("0123456789") == std::string::npos;
    const Parsed<std::int64_t> parsed = parse_number<std::int64_t>(number);
    if (is_padded && has_digits && parsed) numbers.push_back(parsed.value);
  }
  if (failed) throw_file_error(directory, "read", failed.value());
  std::ranges::sort(numbers);
  return numbers;
}

FrameRange parse_frame_range(const std::string& text) {
  const std::size_t between = text.find_first_of("-:");
  const auto first = parse_number<std::int64_t>(std::string_view(text).substr(0, between));
  const auto last =
      between == std::string::npos ? first : parse_number<std::int64_t>(std::string_view(text).substr(between + 1));
  if (!first || !last || first.value < 0 || last.value < first.value)
    throw InvalidOption("--frames " + text + ": it should be the first and the last frame, like 1-24 or 1:24, or one");
  return {first.value, last.value};
}

std::string missing_frames(const std::vector<std::int64_t>& frames, const std::optional<FrameRange>& range) {
  if (frames.empty()) return "";
  std::string missing;
  const auto add = [&](std::int64_t from, std::int64_t to) {
    if (from > to) return;
    missing += (missing.empty() ? "" : ", ") + format_number(from) + (from < to ? "-" + format_number(to) : "");
  };
  std::int64_t next = range ? range->first : frames.front();
  for (const std::int64_t frame : frames) {
    add(next, frame - 1);
    next = frame + 1;
  }
  if (range) add(next, range->last);
  return missing;
}

}  // namespace sublimit
