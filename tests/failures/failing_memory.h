// SPDX-License-Identifier: Apache-2.0
#pragma once
// Failing allocations of this process, and detection of memory that is not freed.
//
// Allocations of this thread by malloc and similar functions are counted and can fail, and so those of operator
// new and Eigen. Excepted are those of oneTBB, FLINT, Arb, GMP and MPFR: oneTBB's scheduler cannot continue
// without memory, and the others can only call set_out_of_memory_handler's handler
// (certificates/numbers/detail/out_of_memory.h). With the address sanitizer, which replaces malloc, only
// operator new fails, and the sanitizer detects leaks.
#include <cstdint>

namespace sublimit::testing {

/// Scope in which an allocation of this thread fails.
class FailingMemory {
 public:
  /// @param at         number of the allocation that fails, from 1; 0: none
  /// @param and_after  true: all later ones fail, too
  explicit FailingMemory(std::int64_t at, bool and_after = false);
  ~FailingMemory();
  FailingMemory(const FailingMemory&) = delete;
  FailingMemory& operator=(const FailingMemory&) = delete;
  std::int64_t count() const;   ///< number of allocations so far
  std::int64_t failed() const;  ///< number of these that failed
  /// Returns true if a `new T[n]` failed. Eigen uses it for the entries of sparse matrices, and leaks one
  /// block, the starts of rows, if memory for the entries of a copy is exhausted.
  bool failed_in_array() const;
};

/// Returns the number of blocks that this thread allocated and did not free; always 0 with the address
/// sanitizer.
std::int64_t blocks_in_use();

}  // namespace sublimit::testing
