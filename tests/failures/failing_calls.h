// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which call of the system fails next, as told to a program from outside: a page that the test and the program share.
#include <atomic>
#include <cstdint>

namespace sublimit::testing {

/// Calls that may fail, each counted by itself.
enum class Call : std::int32_t {
  memory,  ///< malloc, calloc, realloc and their kin, so operator new, Eigen, FLINT, GMP and MPFR too
  map,     ///< mmap by others than malloc
  write,   ///< write, writev, pwrite
  rename,
  open,    ///< of files that are written
  thread,  ///< pthread_create
};
inline constexpr int num_calls = 6;

enum class Failing : std::int32_t {
  once,   ///< the call of that number alone
  on,     ///< that call and all after it
  short_  ///< of writes: half of the bytes are taken, at that call alone
};

/// The page. Counting begins with main().
struct FailingCalls {
  Call call = Call::memory;
  Failing failing = Failing::once;
  std::int32_t error = 0;       ///< errno of what fails
  std::int32_t exempt_tbb = 0;  ///< 1: memory that oneTBB itself asks for neither counts nor fails
  std::int64_t at = 0;          ///< number of the call, from 1; 0: none
  std::atomic<std::int64_t> failed = 0;
  std::atomic<std::int64_t> counts[num_calls] = {};
};

/// The variable with the page's file.
inline constexpr const char* failing_calls_variable = "SUBLIMIT_FAILING_CALLS";

}  // namespace sublimit::testing
