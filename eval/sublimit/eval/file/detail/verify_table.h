// SPDX-License-Identifier: Apache-2.0
#pragma once
// Checks of table files that do not need the mesh of the table.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sublimit {

/// Result of verifying a file.
struct [[nodiscard]] Verification {
  /// Errors and where they are; empty: the table is valid. Of many similar errors the first ones and their number.
  std::vector<std::string> findings;
  std::int64_t bytes = 0;        ///< size of the file
  std::int64_t arrays = 0;       ///< number of arrays
  std::int64_t checksums = 0;    ///< number of checksums compared, of arrays and header
  std::int64_t rows = 0;         ///< number of rows of weights whose sums were checked
  std::int64_t points = 0;       ///< number of points that the table makes
  std::int64_t spare_bytes = 0;  ///< bytes of weights of rows that no patch uses
};

/// Verifies a file. In addition to the checks of loading: checksums; weights of positions sum to 1 and those of
/// derivatives to 0, within rounding; every point is made once, and copied from one that is made; no arrays that do not
/// belong to a table, and no parts of arrays that nothing refers to.
/// @throws IoError, FormatError, ResourceError  a file that cannot be loaded, as `load_table`
Verification verify_table(const std::filesystem::path& path);
/// Verifies the bytes of a file.
/// @param name  name of the file for messages
Verification verify_table(std::span<const std::byte> bytes, const std::string& name);

}  // namespace sublimit
