// SPDX-License-Identifier: Apache-2.0
#pragma once
// All that can be checked of a file of a table without what it was made of.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sublimit {

struct [[nodiscard]] Verification {
  /// What is wrong, and where; none: the table is good. Of many alike the first ones and their number.
  std::vector<std::string> findings;
  std::int64_t bytes = 0;        ///< of the file
  std::int64_t arrays = 0;       ///< in it
  std::int64_t checksums = 0;    ///< of arrays, and of the header, that were compared
  std::int64_t rows = 0;         ///< of weights, whose sums were taken
  std::int64_t points = 0;       ///< that the table makes
  std::int64_t spare_bytes = 0;  ///< weights of rows that no patch makes
};

/// Beyond what loading checks: the checksums; that weights of positions sum to 1 and of derivatives to 0, within
/// rounding; that every point is made once, and copied from one that is made; arrays that are not part of a table, and
/// parts of arrays that nothing refers to.
/// @throws IoError, FormatError, ResourceError  as `load_table` does: a file that cannot be loaded
Verification verify_table(const std::filesystem::path& path);
/// @param name  of the file, for messages
Verification verify_table(std::span<const std::byte> bytes, const std::string& name);

}  // namespace sublimit
