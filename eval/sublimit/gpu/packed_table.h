// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table as kernels read it: weights by fours of rows, tiles of patches, rows side by side. One array of bytes, which
// is uploaded once.
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "sublimit/gpu/kernel_arguments.h"
#include "sublimit/pattern_table.h"

namespace sublimit::gpu {

/// What a thread of `apply_patches` makes.
struct Shape {
  int rows = 1, patches = 1;
};
/// Of many patches that have rows by fours, and of others.
/// @param quantities  made together: 1, 3 or 6
constexpr Shape shape_of(int quantities, bool many) {
  if (!many) return {1, 1};
  return {4, quantities == 1 ? 2 : 1};
}

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

struct PackedTable {
  /// Tiles of few patches and of many, for 1, 3 and 6 quantities.
  std::array<std::array<Part, 2>, 3> patches;
  Part first, rest, copies;
  Image image;

  /// @throws ResourceError     more entries than 32-bit numbers count
  /// @throws InvalidParameter  a copy of a point that is written after it
  explicit PackedTable(const PatternTable<float>& table);
};

/// The same for the transpose: sums are gathered in a fixed order, so that they have the same bits whenever they are
/// made.
struct PackedTranspose {
  Part fold;     ///< copies; none: values are used where they are
  Part patches;  ///< tiles of columns of patches
  Part inputs;   ///< of patches and rows
  Part first;    ///< control points, if inputs are none
  std::int64_t num_parts = 0;
  Image image;

  /// @throws ResourceError  more entries than 32-bit numbers count
  explicit PackedTranspose(const PatternTable<float>& table);
};

}  // namespace sublimit::gpu
