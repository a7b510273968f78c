// SPDX-License-Identifier: Apache-2.0
#pragma once
// Loops over blocks. The split into blocks depends on the range alone, never on the number of threads, so whatever is
// computed per block has the same bits on every machine.
#ifdef __SANITIZE_THREAD__
// The thread sanitizer sees nothing of TBB's own synchronisation, which is not instrumented, and reports races in it.
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <tbb/parallel_for.h>
#endif

#include <algorithm>
#include <cstdint>

#include "sublimit/base/interruption.h"

namespace sublimit {

/// Rows or elements per block: some tens of microseconds of work, small enough to balance.
inline constexpr std::int64_t block_size = 4096;

constexpr std::int64_t num_blocks(std::int64_t count, std::int64_t size = block_size) {
  return (count + size - 1) / size;
}

/// Calls body(block, begin, end) for every block of [0, count), in parallel. It returns when all are done, and throws
/// what one of them threw, or an interruption; the rest may then be left out. Loops inside of others go on by
/// themselves: TBB's own would return halfway where another block of the outer one has failed.
template <class Body>
void parallel_for_blocks(std::int64_t count, const Body& body, std::int64_t size = block_size) {
  const std::int64_t blocks = num_blocks(count, size);
  const auto run = [&](std::int64_t block) {
    check_interruption();
    body(block, block * size, std::min(count, (block + 1) * size));
  };
  if (blocks <= 1) {  // small meshes never pay for the scheduler
    if (blocks == 1) run(0);
    return;
  }
#ifdef __SANITIZE_THREAD__
  std::atomic<std::int64_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::int64_t block; (block = next++) < blocks;) {
      try {
        run(block);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = blocks;
      }
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
#else
  tbb::task_group_context own(tbb::task_group_context::isolated);
  tbb::parallel_for(std::int64_t{0}, blocks, run, own);
#endif
}

/// Calls body(i) for every i of [0, count), in parallel.
template <class Body>
void parallel_for(std::int64_t count, const Body& body) {
  parallel_for_blocks(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) body(i);
  });
}

}  // namespace sublimit
