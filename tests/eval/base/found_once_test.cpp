// SPDX-License-Identifier: Apache-2.0
#include "sublimit/base/detail/found_once.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "sublimit/base/detail/parallel_for.h"

namespace sublimit {
namespace {

using namespace std::chrono_literals;

/// More threads than this machine may have cores: what they do comes in any order.
constexpr unsigned num_threads = 8;
using Limit = tbb::global_control;

/// Each thread calls body(its number).
template <class Body>
void by_threads(size_t count, const Body& body) {
  std::vector<std::thread> threads;
  for (size_t k = 0; k < count; ++k) threads.emplace_back([&body, k] { body(k); });
  for (std::thread& thread : threads) thread.join();
}

/// The sum of 0 to 15 by a loop of as many blocks. Whoever comes to help is the last to be done, so that the thread
/// that began it has to wait, and would look for other work.
constexpr int sum = 120;
int sum_by_loop() {
  const std::thread::id own = std::this_thread::get_id();
  std::vector<int> of_block(16);
  parallel_for_blocks(
      16,
      [&](std::int64_t block, std::int64_t, std::int64_t) {
        std::this_thread::sleep_for(own == std::this_thread::get_id() ? 200us : 5ms);
        of_block[size_t(block)] = int(block);
      },
      1);
  return std::accumulate(of_block.begin(), of_block.end(), 0);
}

TEST(ComputedOnce, IsFoundByOneThreadAndTheSameForAll) {
  for (int round = 0; round < 10; ++round) {
    const ComputedOnce<std::string> once;
    std::atomic<int> calls = 0;
    std::vector<const std::string*> seen(num_threads);
    EXPECT_EQ(once.known(), nullptr);
    by_threads(num_threads, [&](size_t k) {
      seen[k] = &once.get([&] {
        ++calls;
        return std::string(100, 'x');
      });
    });
    EXPECT_EQ(calls, 1);
    for (const std::string* value : seen) EXPECT_EQ(value, once.known());
    EXPECT_EQ(*once.known(), std::string(100, 'x'));
  }
}

/// A thread that waits for the loop inside of find() must not take up a block of the outer loop, which asks for the
/// same value: it would wait for itself.
TEST(ComputedOnce, FindsInsideOfLoopsByLoops) {
  for (const size_t threads : {1, 2, 8}) {
    const Limit limit(Limit::max_allowed_parallelism, threads);
    for (int round = 0; round < 5; ++round) {
      std::vector<ComputedOnce<int>> values(3);
      std::atomic<int> wrong = 0;
      parallel_for_blocks(
          64,
          [&](std::int64_t block, std::int64_t, std::int64_t) {
            wrong += values[size_t(block) % 3].get(sum_by_loop) != sum;
          },
          1);
      EXPECT_EQ(wrong, 0);
    }
  }
}

/// Threads that share an arena take up each other's blocks, also one that finds outside of any loop.
TEST(ComputedOnce, FindsWhereThreadsShareAnArena) {
  const Limit limit(Limit::max_allowed_parallelism, num_threads);
  tbb::task_arena arena{int{num_threads}, 2};
  for (int round = 0; round < 10; ++round) {
    const ComputedOnce<int> value;
    // One finds, outside of any loop; the other one's blocks, and those that come to help, wait for it.
    by_threads(2, [&](size_t k) {
      arena.execute([&] {
        if (k == 0) {
          EXPECT_EQ(value.get(sum_by_loop), sum);
        } else {
          parallel_for_blocks(
              256, [&](std::int64_t, std::int64_t, std::int64_t) { EXPECT_EQ(value.get(sum_by_loop), sum); }, 1);
        }
      });
    });
  }
}

TEST(ComputedOnce, ValuesMayNeedOthers) {
  for (int round = 0; round < 5; ++round) {
    std::vector<ComputedOnce<int>> chain(10);
    const auto value = [&](const auto& self, size_t i) -> int {
      return chain[i].get([&] { return sum_by_loop() + (i > 0 ? self(self, i - 1) : 0); });
    };
    // Some begin at one end, some at the other.
    by_threads(num_threads, [&](size_t k) {
      parallel_for_blocks(
          10,
          [&](std::int64_t i, std::int64_t, std::int64_t) {
            const auto at = size_t(k % 2 ? i : 9 - i);
            EXPECT_EQ(value(value, at), int(at + 1) * sum);
          },
          1);
    });
  }
}

TEST(ComputedOnce, KeepsThatThereIsNone) {
  const ComputedOnce<int> once;
  std::atomic<int> calls = 0, told = 0;
  by_threads(num_threads, [&](size_t) {
    try {
      once.get([&]() -> int {
        ++calls;
        throw AnalysisError("no limit at valence 7");
      });
    } catch (const AnalysisError& error) {
      told += error.what() == std::string("no limit at valence 7");
    }
  });
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(told, int(num_threads));
  EXPECT_EQ(once.known(), nullptr);
}

/// Where there was no memory there may be some now; and who waited finds it.
TEST(ComputedOnce, TriesAgainAfterAnyOtherError) {
  for (int round = 0; round < 10; ++round) {
    const ComputedOnce<int> once;
    std::atomic<int> calls = 0, failed = 0, found = 0;
    by_threads(num_threads, [&](size_t) {
      try {
        found += once.get([&] {
          if (++calls <= 3) throw std::bad_alloc();
          return 1;
        });
      } catch (const std::bad_alloc&) {
        ++failed;
      }
    });
    EXPECT_EQ(failed, 3);
    EXPECT_EQ(calls, 4);
    EXPECT_EQ(found, int(num_threads) - 3);
  }
}

TEST(FoundByKey, FindsEachOnceWhileOthersAreFound) {
  for (const size_t threads : {1, 2, 8}) {
    const Limit limit(Limit::max_allowed_parallelism, threads);
    const FoundByKey<int, int> ordered;
    const FoundByKey<int, int, std::hash<int>> hashed;
    std::atomic<int> calls = 0;
    by_threads(num_threads, [&](size_t k) {
      parallel_for_blocks(
          100,
          [&](std::int64_t i, std::int64_t, std::int64_t) {
            const int key = int((i * 7 + std::int64_t(k) * 13) % 20);
            const auto find = [&] {
              ++calls;
              return sum_by_loop() + key;
            };
            EXPECT_EQ(ordered.get(key, find), sum + key);
            EXPECT_EQ(hashed.get(key, find), sum + key);
          },
          1);
    });
    EXPECT_EQ(calls, 40);
    EXPECT_EQ(ordered.size(), 20u);
    EXPECT_EQ(hashed.size(), 20u);
    std::vector<int> keys;
    ordered.for_each([&](int key, int) { keys.push_back(key); });
    EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
  }
}

/// While one value is being found, another one is, by another thread: no lock is held over all.
TEST(FoundByKey, DoesNotWaitForOtherKeys) {
  const FoundByKey<int, int> values;
  std::atomic<bool> second_is_known = false;
  std::thread first([&] {
    values.get(1, [&] {
      while (!second_is_known) std::this_thread::yield();
      return 1;
    });
  });
  EXPECT_EQ(values.get(2, [] { return 2; }), 2);
  second_is_known = true;
  first.join();
  EXPECT_EQ(*values.known(1), 1);
}

TEST(FoundByKey, KeepsWhatItKnows) {
  FoundByKey<int, std::string> values;
  values.add(3, "three");
  values.add(3, "another");
  EXPECT_EQ(*values.known(3), "three");
  EXPECT_EQ(values.known(4), nullptr);
  EXPECT_THROW(values.get(4, []() -> std::string { throw AnalysisError("none"); }), AnalysisError);
  EXPECT_THROW(values.get(5, []() -> std::string { throw std::runtime_error("for now"); }), std::runtime_error);
  EXPECT_EQ(values.size(), 1u);
  EXPECT_THROW(values.get(4, [] { return std::string("four"); }), AnalysisError);
  EXPECT_EQ(values.get(5, [] { return std::string("five"); }), "five");
  const std::string* const three = values.known(3);
  const FoundByKey<int, std::string> moved = std::move(values);
  EXPECT_EQ(moved.known(3), three);
}

}  // namespace
}  // namespace sublimit
