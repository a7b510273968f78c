// SPDX-License-Identifier: Apache-2.0
#pragma once
// Allocations of this process that fail, and what is not given back.
//
// Counted and failed is what this thread takes from malloc and its kin, so operator new and Eigen's too. Left out is
// what oneTBB, FLINT, Arb, GMP and MPFR ask for: oneTBB's scheduler cannot go on without, and the others have no way
// out but set_out_of_memory_handler (certificates/numbers/detail/out_of_memory.h). Under the address sanitizer, whose
// malloc it is, operator new alone fails, and the sanitizer counts what is left.
#include <cstdint>

namespace sublimit::testing {

/// Lets an allocation of this thread fail for as long as it lives.
class FailingMemory {
 public:
  /// @param at        number of the allocation, from 1; 0: none
  /// @param and_after  all after it fail too
  explicit FailingMemory(std::int64_t at, bool and_after = false);
  ~FailingMemory();
  FailingMemory(const FailingMemory&) = delete;
  FailingMemory& operator=(const FailingMemory&) = delete;
  std::int64_t count() const;   ///< of allocations so far
  std::int64_t failed() const;  ///< of these
  /// Whether `new T[n]` was among them. It is Eigen that uses it, for entries of sparse matrices: without memory for
  /// the entries of a copy it loses the starts of its rows, one block.
  bool failed_in_array() const;
};

/// Blocks that this thread took less those that it gave back; always 0 under the address sanitizer.
std::int64_t blocks_in_use();

}  // namespace sublimit::testing
