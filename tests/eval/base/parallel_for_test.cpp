// SPDX-License-Identifier: Apache-2.0
#include "sublimit/base/detail/parallel_for.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace sublimit {
namespace {

using namespace std::chrono_literals;

/// Where a block of a loop fails while another is inside of a loop of its own, that one is done to its end: what comes
/// behind it relies on all that it writes.
TEST(ParallelFor, LoopsInsideGoOnWhereTheOuterOneFails) {
  std::atomic<bool> another{false}, fails{false};
  std::atomic<int> loops{0}, halfway{0};
  const auto until = [](const std::atomic<bool>& flag) {
    const auto end = std::chrono::steady_clock::now() + 5s;  // with a single thread nobody comes
    while (!flag && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(1ms);
  };
  const auto body = [&](std::int64_t block, std::int64_t, std::int64_t) {
    if (!another.exchange(true)) {
      until(fails);
      for (const auto end = std::chrono::steady_clock::now() + 100ms; std::chrono::steady_clock::now() < end; ++loops) {
        std::atomic<int> done{0};
        parallel_for_blocks(
            64, [&](std::int64_t, std::int64_t, std::int64_t) { ++done; }, 1);
        halfway += done != 64;
      }
    } else if (!fails.exchange(true)) {
      throw std::runtime_error("block " + std::to_string(block));
    }
  };
  EXPECT_THROW(parallel_for_blocks(16, body, 1), std::runtime_error);
  EXPECT_GT(loops, 0);
  EXPECT_EQ(halfway, 0) << "of " << loops;
}

/// A thread that waits for a loop inside of a block takes up no block of another one: buffers of its own, and locks,
/// are the block's until it is done.
TEST(ParallelFor, BlocksAreNotTakenUpInsideOfOthers) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 8);
  tbb::task_arena arena{8, 2};  // both loops are in it, so that threads of one help with the other
  static thread_local int inside = 0;
  std::atomic<int> deepest{0};
  const auto begin = [&] {
    ++inside;
    for (int before = deepest; inside > before && !deepest.compare_exchange_weak(before, inside);) continue;
  };
  const auto with_loop = [&](std::int64_t, std::int64_t, std::int64_t) {
    begin();
    const std::thread::id own = std::this_thread::get_id();
    parallel_for_blocks(
        16,
        [&](std::int64_t, std::int64_t, std::int64_t) {  // who helps is the last to be done
          std::this_thread::sleep_for(own == std::this_thread::get_id() ? 200us : 5ms);
        },
        1);
    --inside;
  };
  const auto without = [&](std::int64_t, std::int64_t, std::int64_t) {
    begin();
    std::this_thread::sleep_for(1ms);
    --inside;
  };
  for (int round = 0; round < 10; ++round) {
    std::thread other([&] { arena.execute([&] { parallel_for_blocks(64, without, 1); }); });
    arena.execute([&] { parallel_for_blocks(2, with_loop, 1); });
    other.join();
  }
  EXPECT_EQ(deepest, 1);
}

TEST(ParallelFor, BlocksCoverTheRangeOnce) {
  for (const std::int64_t count : {0, 1, 6, 7, 8, 49, 50}) {
    std::vector<std::atomic<int>> seen(static_cast<size_t>(count));
    parallel_for_blocks(
        count,
        [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
          EXPECT_EQ(begin, 7 * block);
          for (std::int64_t i = begin; i < end; ++i) ++seen[size_t(i)];
        },
        7);
    for (const auto& times : seen) EXPECT_EQ(times, 1);
  }
}

TEST(ParallelFor, CountsBlocksForAWatcher) {
  LoopProgress progress;
  watch_loops(&progress);
  std::atomic<bool> is_between{true};
  const auto inside = [&](std::int64_t, std::int64_t, std::int64_t) {
    if (progress.blocks != 10 && progress.blocks != 2) is_between = false;
    if (progress.done >= progress.blocks) is_between = false;
    parallel_for_blocks(
        64, [](std::int64_t, std::int64_t, std::int64_t) {}, 1);
  };
  parallel_for_blocks(10, inside, 1);
  EXPECT_TRUE(is_between) << "loops inside are not counted";
  EXPECT_EQ(progress.loops, 1);
  EXPECT_EQ(progress.done, 10);
  parallel_for_blocks(10, inside, 5);
  EXPECT_EQ(progress.loops, 2);
  EXPECT_EQ(progress.blocks, 2);
  EXPECT_EQ(progress.done, 2);
  watch_loops(nullptr);
  parallel_for_blocks(
      10, [](std::int64_t, std::int64_t, std::int64_t) {}, 1);
  EXPECT_EQ(progress.loops, 2);
}

}  // namespace
}  // namespace sublimit
