// SPDX-License-Identifier: Apache-2.0
#pragma once
// Arrays of a table for the memory of a device, as one array of bytes that is uploaded once; what all who pack share.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/gpu/kernel_arguments.h"
#include "sublimit/pattern_table.h"

namespace sublimit::gpu {

using Arrays = PatternTable<float>::Arrays;

/// Arrays one after the other, each at a multiple of 64 bytes, and places that are to hold an address of one of them.
class Image {
 public:
  /// @return  where it begins
  template <class T>
  std::int64_t add(std::span<const T> numbers) {
    return add_bytes(std::as_bytes(numbers));
  }
  std::int64_t add_bytes(std::span<const std::byte> bytes);
  /// A structure whose member at `offset` is to be the address of what begins at `target`.
  void set_address(std::int64_t structure, size_t offset, std::int64_t target) {
    addresses_.push_back({structure + std::int64_t(offset), target});
  }
  /// All bytes, for an array that begins at this address.
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

/// What is to be launched for a part of a table.
struct Part {
  std::int64_t table = -1;  ///< where the structure lies that a kernel begins with; -1: there is none
  std::int64_t count = 0;   ///< tiles, rows or pairs
};

/// A count as kernels have it.
/// @param what  is counted, in the plural
/// @throws ResourceError  more than 31 bits
std::uint32_t number(std::int64_t value, const char* what);

/// That there may be more weights of so many quantities, before they are packed.
/// @throws ResourceError  more than 31 bits count
inline void check_weights(std::int64_t packed, std::int64_t of_quantity, int quantities) {
  number(packed + std::int64_t{number(of_quantity, "weights")} * quantities, "weights");
}

constexpr std::int64_t rounded_up(std::int64_t value, std::int64_t multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

/// A row of the block of a group, for one quantity.
const float* row_of(const Arrays& a, const PatternTable<float>::Group& group, std::int64_t row, int quantity);

/// The same for groups that make the same rows of a block: their weights are packed once.
std::vector<std::int32_t> rows_key(const Arrays& a, const PatternTable<float>::Group& group);

/// Adds where the points of each patch begin; -1: they follow those of the patch before.
std::int64_t pack_patch_points(const Arrays& a, Image& image);

}  // namespace sublimit::gpu
