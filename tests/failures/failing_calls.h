// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control of failing system calls in a program under test, by a page of memory that the test and the program
// share.
#include <atomic>
#include <cstdint>

namespace sublimit::testing {

/// Kinds of calls that can fail, each counted separately.
enum class Call : std::int32_t {
  memory,  ///< malloc and similar functions, and so operator new, Eigen, FLINT, GMP, MPFR
  map,     ///< mmap, except from malloc
  write,   ///< write, writev, pwrite
  rename,
  open,    ///< open of files for writing
  thread,  ///< pthread_create
};
inline constexpr int num_calls = 6;

enum class Failing : std::int32_t {
  once,   ///< only the call of that number
  on,     ///< that call and all later ones
  short_  ///< for writes: only that call, which writes half of the bytes
};

/// The shared page. Counting starts with main().
struct FailingCalls {
  Call call = Call::memory;
  Failing failing = Failing::once;
  std::int32_t error = 0;       ///< errno of failing calls
  std::int32_t exempt_tbb = 0;  ///< 1: allocations of oneTBB itself are neither counted nor fail
  std::int64_t at = 0;          ///< number of the call, from 1; 0: none
  std::atomic<std::int64_t> failed = 0;
  std::atomic<std::int64_t> counts[num_calls] = {};
};

/// Name of the environment variable with the file of the page.
inline constexpr const char* failing_calls_variable = "SUBLIMIT_FAILING_CALLS";

}  // namespace sublimit::testing
