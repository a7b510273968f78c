// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a program allocates, counted below operator new, so that Eigen's and C's count as well. A program counts if it
// calls one of these. Under sanitizers, which have allocators of their own, and elsewhere than with glibc, nothing is
// counted.
#include <cstdint>

namespace sublimit::testing {

/// Whether this program counts.
bool allocations_are_counted();
/// Of this thread, so far.
std::int64_t allocations();
/// What they asked for, together: no rounding of the allocator's, which depends on what was freed before.
std::int64_t allocated_bytes();

}  // namespace sublimit::testing
