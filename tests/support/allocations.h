// SPDX-License-Identifier: Apache-2.0
#pragma once
// Counting the allocations of a program below operator new, so that those of Eigen and C are included. A
// program that calls one of these functions counts. Nothing is counted under sanitizers, which have their own
// allocators, and with other C libraries than glibc.
#include <cstdint>

namespace sublimit::testing {

/// Returns true if this program counts allocations.
bool allocations_are_counted();
/// Returns the number of allocations of this thread so far.
std::int64_t allocations();
/// Returns the bytes that they requested in all, without the allocator's rounding, which depends on freed
/// blocks.
std::int64_t allocated_bytes();

}  // namespace sublimit::testing
