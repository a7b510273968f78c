// SPDX-License-Identifier: Apache-2.0
#pragma once
// Indices of OBJ files. They count from 1, or backwards from -1, the last element so far. Elements of positive
// indices may come later in the file, so those are checked at its end.
#include <cstdint>
#include <string_view>
#include <vector>

#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {

class ObjIndices {
 public:
  /// @param what  name of the elements, in the plural
  explicit ObjIndices(std::string_view what) : what_(what) {}

  /// Returns the index of a token, counted from 0. Values too large for an Index become the largest one, which
  /// `check` refuses.
  /// @throws FormatError  no integer, or 0;  InvalidMesh  one that counts back beyond the first of `so_far`
  Index read(const TextScanner& scanner, std::string_view token, std::int64_t so_far);

  /// Throws unless all indices are below the count of the whole file.
  /// @throws InvalidMesh  an index that is not
  void check(const TextScanner& scanner, std::int64_t count) const;

 private:
  struct Forward {
    std::int64_t index, line;
  };
  std::string what_;
  std::vector<Forward> forward_;  // ascending
};

/// Throws for index 0.
/// @throws FormatError  always
[[noreturn]] void reject_index_zero(const TextScanner& scanner);

}  // namespace sublimit
