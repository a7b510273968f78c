// SPDX-License-Identifier: Apache-2.0
#pragma once
// Common code of mesh writers.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Returns comments as lines that start with `mark`; a comment of several lines becomes several lines.
inline std::string format_comments(const std::vector<std::string>& comments, std::string_view mark) {
  std::string out;
  for (const std::string& comment : comments) {
    out += mark;
    for (const char c : comment) {
      if (c != '\r') out += c;
      if (c == '\n') out += mark;
    }
    out += '\n';
  }
  return out;
}

/// Returns the first corner of every `faces_per_block`-th face.
inline std::vector<std::size_t> first_corners(const std::vector<Index>& face_sizes, std::int64_t faces_per_block) {
  std::vector<std::size_t> first;
  std::size_t corner = 0;
  for (std::size_t f = 0; f < face_sizes.size(); ++f) {
    if (f % static_cast<std::size_t>(faces_per_block) == 0) first.push_back(corner);
    corner += static_cast<std::size_t>(face_sizes[f]);
  }
  return first;
}

}  // namespace sublimit
