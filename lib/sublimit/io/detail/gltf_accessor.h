// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of numbers of a glTF file: an accessor says where they are in a buffer and of which type, and may replace some.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/io/detail/gltf_file.h"

namespace sublimit {

/// Types of numbers in buffers.
enum class GltfType : int { int8 = 5120, uint8, int16, uint16, uint32 = 5125, float32 };

/// The rows of an accessor. Their place in the file has been checked: a row is read without further checks.
class GltfAccessor {
 public:
  /// @param file    must outlive this
  /// @param number  of the accessor
  /// @throws FormatError  rows that are not within their buffers, unknown types
  GltfAccessor(GltfFile& file, std::int64_t number);

  /// Returns the number of rows.
  std::int64_t count() const { return count_; }
  /// Returns the numbers of a row.
  int columns() const { return columns_; }
  /// Returns the type of its numbers in the file.
  GltfType type() const { return type_; }
  /// Returns true for integers that stand for 0 to 1, or -1 to 1.
  bool is_normalized() const { return normalized_; }
  /// Returns where it is in the file, for messages.
  const std::string& place() const { return place_; }

  /// Returns a number as it is in the file.
  double raw(std::int64_t row, int column) const;
  /// Returns a number; normalized integers as 0 to 1, or -1 to 1.
  double value(std::int64_t row, int column) const;

 private:
  /// Rows at some places of a buffer.
  struct Rows {
    std::string_view bytes = {};
    std::int64_t stride = 0;
  };
  Rows rows(GltfFile& file, const GltfObject& object, const char* view_key, std::int64_t row_bytes,
            std::int64_t count) const;
  void read_sparse(GltfFile& file, const GltfObject& sparse);

  std::string place_;
  GltfType type_ = GltfType::float32;
  bool normalized_ = false;
  int columns_ = 1;
  std::int64_t count_ = 0;
  Rows rows_;          // no bytes: zeros
  Rows replacements_;  // of the rows `replaced_`, which ascend
  std::vector<std::uint32_t> replaced_;
};

}  // namespace sublimit
