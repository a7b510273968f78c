// SPDX-License-Identifier: Apache-2.0
#pragma once
// Annotations for the thread sanitizer. TBB's library is not instrumented: the sanitizer sees tasks on many threads,
// but not how TBB synchronises them. Parallel loops therefore declare that writes before the loop are visible in every
// block, and writes of blocks after the loop. TBB's headers are excluded by tests/thread_sanitizer.txt. Other builds
// contain none of this.
#if defined(__SANITIZE_THREAD__)
#define SUBLIMIT_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SUBLIMIT_THREAD_SANITIZER
#endif
#endif

#ifdef SUBLIMIT_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
/// Excludes a function that reads data of another thread before the order of both is declared.
#define SUBLIMIT_NOT_WATCHED __attribute__((no_sanitize("thread")))
#else
#define SUBLIMIT_NOT_WATCHED
#endif

namespace sublimit::detail {

/// Order between the thread that starts a loop and those that execute its blocks.
#ifdef SUBLIMIT_THREAD_SANITIZER
class HandOver {
 public:
  HandOver() { __tsan_release(&there_); }
  ~HandOver() { __tsan_acquire(&back_); }
  HandOver(const HandOver&) = delete;
  HandOver& operator=(const HandOver&) = delete;

  /// Scope of the execution of a block.
  class Taken {
   public:
    SUBLIMIT_NOT_WATCHED explicit Taken(const HandOver& from) : from_(from) { __tsan_acquire(&from.there_); }
    SUBLIMIT_NOT_WATCHED ~Taken() { __tsan_release(&from_.back_); }
    Taken(const Taken&) = delete;
    Taken& operator=(const Taken&) = delete;

   private:
    const HandOver& from_;
  };

 private:
  mutable char there_ = 0, back_ = 0;  // addresses that the sanitizer knows
};
#else
struct HandOver {
  struct Taken {
    explicit Taken(const HandOver&) {}
  };
};
#endif

}  // namespace sublimit::detail
