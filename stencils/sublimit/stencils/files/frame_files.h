// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sequences of files with a frame each: "pose.####.ply" stands for pose.0001.ply, pose.0002.ply, ..., pose.10000.ply.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sublimit {

/// The name of a sequence: one # for each digit of the frame's number, with zeros in front. Larger numbers have more
/// digits.
class FramePattern {
 public:
  /// Returns the pattern of a path whose file name has #; absent if it has none, or if there is a file of that name.
  /// @throws InvalidOption  # in two places
  static std::optional<FramePattern> find(const std::filesystem::path& path);

  /// Returns the file of a frame.
  std::filesystem::path file(std::int64_t frame) const;
  /// Returns the numbers of the frames that have a file, in order.
  /// @throws IoError  the directory cannot be read
  std::vector<std::int64_t> frames() const;

 private:
  FramePattern(std::filesystem::path directory, std::string before, std::size_t digits, std::string behind)
      : directory_(std::move(directory)), before_(std::move(before)), behind_(std::move(behind)), digits_(digits) {}
  std::filesystem::path directory_;
  std::string before_, behind_;
  std::size_t digits_;
};

/// Numbers of frames, both ends included.
struct FrameRange {
  std::int64_t first = 0, last = 0;
};
/// Reads "3-8", "3:8" or "3".
/// @throws InvalidOption  another text, or a last frame before the first
FrameRange parse_frame_range(const std::string& text);

/// Returns numbers that are missing between those of a list in order, "5, 7-9"; empty if none is.
/// @param range  what the list should have, if given: else all from its first to its last
std::string missing_frames(const std::vector<std::int64_t>& frames, const std::optional<FrameRange>& range);

}  // namespace sublimit
