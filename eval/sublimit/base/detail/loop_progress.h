// SPDX-License-Identifier: Apache-2.0
#pragma once
// How far the parallel loop is that runs now (parallel_for.h), for programs that show it while they wait.
#include <atomic>
#include <cstdint>

namespace sublimit {

/// Counts of a loop, which any thread may read.
struct LoopProgress {
  std::atomic<std::int64_t> loops = 0;   ///< begun so far: another number, another loop
  std::atomic<std::int64_t> blocks = 0;  ///< of the loop that was begun last
  std::atomic<std::int64_t> done = 0;    ///< of them
};

namespace detail {

inline constinit std::atomic<LoopProgress*> watched_loops = nullptr;

/// Counts the blocks of a loop while its progress is shown. Loops inside of blocks are not counted.
class LoopCount {
 public:
  LoopCount(std::int64_t blocks, bool is_inside) : progress_(is_inside ? nullptr : watched_loops.load()) {
    if (!progress_) return;
    progress_->done = 0;
    progress_->blocks = blocks;
    ++progress_->loops;
  }
  /// Counts a block that is done.
  void add() const noexcept {
    if (progress_) progress_->done.fetch_add(1, std::memory_order_relaxed);
  }

 private:
  LoopProgress* progress_;
};

}  // namespace detail

/// Watches the loops of this process, one watcher at a time; null ends it. What is watched must outlive every loop.
inline void watch_loops(LoopProgress* progress) { detail::watched_loops = progress; }

}  // namespace sublimit
