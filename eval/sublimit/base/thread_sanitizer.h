// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the thread sanitizer cannot see for itself. TBB's library is not instrumented, so it sees tasks of many threads
// and nothing of how TBB makes them wait for each other. A loop says what it promises: what was written before it is
// there in every block, and what blocks write is there behind it. What TBB's own headers do is left out by
// tests/thread_sanitizer.txt. In all other builds there is nothing of this.
#if defined(__SANITIZE_THREAD__)
#define SUBLIMIT_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SUBLIMIT_THREAD_SANITIZER
#endif
#endif

#ifdef SUBLIMIT_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
/// Of functions that read what another thread wrote, before they have said that it did so first.
#define SUBLIMIT_NOT_WATCHED __attribute__((no_sanitize("thread")))
#else
#define SUBLIMIT_NOT_WATCHED
#endif

namespace sublimit::detail {

/// From the thread that begins a loop to those that run its blocks, and back.
#ifdef SUBLIMIT_THREAD_SANITIZER
class HandOver {
 public:
  HandOver() { __tsan_release(&there_); }
  ~HandOver() { __tsan_acquire(&back_); }
  HandOver(const HandOver&) = delete;
  HandOver& operator=(const HandOver&) = delete;

  /// While a block runs.
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
