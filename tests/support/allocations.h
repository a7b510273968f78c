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

/// Bytes of all threads that were asked for and not given back, at most since the last call of `forget_peak`, above
/// those of that moment. With the allocator's rounding, which is the same for the same calls.
std::int64_t peak_of_bytes();
void forget_peak();

}  // namespace sublimit::testing
