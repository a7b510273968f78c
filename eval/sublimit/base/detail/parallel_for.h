// SPDX-License-Identifier: Apache-2.0
#pragma once
// Loops over blocks. The split into blocks depends on the range alone, never on the number of threads, so whatever is
// computed per block has the same bits on every machine.
#include <tbb/parallel_for.h>
#include <tbb/task.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>

#include "sublimit/base/detail/interruption.h"
#include "sublimit/base/detail/loop_progress.h"
#include "sublimit/base/detail/thread_sanitizer.h"

namespace sublimit {

/// Rows or elements per block: some tens of microseconds of work, small enough to balance.
inline constexpr std::int64_t block_size = 4096;

constexpr std::int64_t num_blocks(std::int64_t count, std::int64_t size = block_size) {
  return (count + size - 1) / size;
}

namespace detail {

/// Functor for a block in the form that TBB takes.
template <class Run>
struct LoopBlock {
  const Run& run;
  const HandOver& hand_over;

  SUBLIMIT_NOT_WATCHED void operator()(std::int64_t block) const {
    const HandOver::Taken taken(hand_over);
    run(block);
  }
};

}  // namespace detail

/// Calls body(block, begin, end) for every block of [0, count), in parallel. Returns when all are done. Rethrows an
/// exception of a block, or of an interruption; other blocks may then be skipped.
///
/// A loop inside a block of another loop is isolated. It is not cancelled if another block of the outer loop fails, as
/// loops of TBB are; and a thread that waits for it executes no other block of the outer loop, so locks and buffers of
/// the waiting block's thread remain its own.
template <class Body>
void parallel_for_blocks(std::int64_t count, const Body& body, std::int64_t size = block_size) {
  const std::int64_t blocks = num_blocks(count, size);
  if (blocks <= 1) {  // small meshes never pay for the scheduler
    if (blocks < 1) return;
    check_interruption();
    body(std::int64_t{0}, std::int64_t{0}, count);
    return;
  }
  const detail::LoopCount counted(blocks, tbb::task::current_context() != nullptr);
  const auto run = [&](std::int64_t block) {
    check_interruption();
    body(block, block * size, std::min(count, (block + 1) * size));
    counted.add();
  };
  const auto loop = [&] {
    const detail::HandOver hand_over;
    tbb::task_group_context own(tbb::task_group_context::isolated);
    tbb::parallel_for(std::int64_t{0}, blocks, detail::LoopBlock<decltype(run)>{run, hand_over}, own);
  };
  if (tbb::task::current_context())
    tbb::this_task_arena::isolate(loop);
  else
    loop();
}

/// Calls body(i) for every i of [0, count), in parallel.
template <class Body>
void parallel_for(std::int64_t count, const Body& body) {
  parallel_for_blocks(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) body(i);
  });
}

}  // namespace sublimit
