// SPDX-License-Identifier: Apache-2.0
#pragma once
// Indices of OBJ files: they count from 1, or backwards from -1, the last one so far. What a positive one names may
// come later in the file, so those are checked at its end.
#include <cstdint>
#include <string_view>
#include <vector>

#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {

class ObjIndices {
 public:
  /// @param what  what they count, in the plural
  explicit ObjIndices(std::string_view what) : what_(what) {}

  /// The index that `token` spells, from 0. What is too large for an Index is its largest, which `check` refuses.
  /// @throws FormatError  no integer, or 0;  InvalidMesh  one that counts back beyond the first of `so_far`
  Index read(const TextScanner& scanner, std::string_view token, std::int64_t so_far);

  /// @throws InvalidMesh  an index that was read is beyond the `count` of the whole file
  void check(const TextScanner& scanner, std::int64_t count) const;

 private:
  struct Forward {
    std::int64_t index, line;
  };
  std::string what_;
  std::vector<Forward> forward_;  // ascending
};

/// @throws FormatError  always: "index 0"
[[noreturn]] void reject_index_zero(const TextScanner& scanner);

}  // namespace sublimit
