// SPDX-License-Identifier: Apache-2.0
#pragma once
// The arrays of a packed table as one array of bytes, which is uploaded once.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/eval/gpu/detail/kernel_arguments.h"
#include "sublimit/eval/table/pattern_table.h"

namespace sublimit::gpu {

using Arrays = PatternTable<float>::Arrays;

/// Arrays one after the other, each at a multiple of 64 bytes, and pointers between them, set when the address on the
/// device is known.
class Image {
 public:
  /// Appends an array, and returns its offset.
  template <class T>
  std::int64_t add(std::span<const T> numbers) {
    return add_bytes(std::as_bytes(numbers));
  }
  /// Appends bytes, and returns their offset.
  std::int64_t add_bytes(std::span<const std::byte> bytes);
  /// Makes the member at `offset` of the structure at `structure` point to `target`.
  void set_address(std::int64_t structure, size_t offset, std::int64_t target) {
    addresses_.push_back({structure + std::int64_t(offset), target});
  }
  /// Returns all bytes, with pointers for an image at this address.
  std::span<const std::byte> at(std::uint64_t address);
  std::int64_t num_bytes() const { return std::int64_t(bytes_.size()); }
  void clear() { bytes_ = {}; }

 private:
  struct Address {
    std::int64_t at, target;
  };
  std::vector<std::byte> bytes_;
  std::vector<Address> addresses_;
};

/// A part of a table that is launched as one kernel.
struct Part {
  std::int64_t table = -1;  ///< offset of the structure that the kernel starts from; -1: none
  std::int64_t count = 0;   ///< number of tiles, rows or pairs
};

/// Returns a count as a number of 32 bits.
/// @param what  the counted things, in the plural, for the message
/// @throws ResourceError  more than 31 bits hold
std::uint32_t number(std::int64_t value, const char* what);

/// Checks the number of weights before more are packed.
/// @throws ResourceError  more than 31 bits count
inline void check_weights(std::int64_t packed, std::int64_t of_quantity, int quantities) {
  number(packed + std::int64_t{number(of_quantity, "weights")} * quantities, "weights");
}

constexpr std::int64_t rounded_up(std::int64_t value, std::int64_t multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

/// Returns a row of the block of a group, for one quantity.
const float* row_of(const Arrays& a, const PatternTable<float>::Group& group, std::int64_t row, int quantity);

/// Returns a key that is equal for groups with the same rows of a block, whose weights are packed once.
std::vector<std::int32_t> rows_key(const Arrays& a, const PatternTable<float>::Group& group);

/// Appends the first points of patches, and returns their offset; -1: points of a patch follow those of the previous
/// one.
std::int64_t pack_patch_points(const Arrays& a, Image& image);

}  // namespace sublimit::gpu
