// SPDX-License-Identifier: Apache-2.0
#pragma once
// Interrupting long work, for example by Ctrl-C. Between the blocks of a parallel loop (parallel_for.h), the thread
// that started it calls a function of the caller, which may throw; the loop then ends as for any other exception.

namespace sublimit {

namespace detail {
using Check = void();
inline constinit thread_local Check* interruption = nullptr;
}  // namespace detail

inline void check_interruption() {
  if (detail::interruption) detail::interruption();
}

/// Sets the function that loops started by this thread call, until the end of the scope.
class InterruptionScope {
 public:
  explicit InterruptionScope(void (*check)()) : before_(detail::interruption) { detail::interruption = check; }
  ~InterruptionScope() { detail::interruption = before_; }
  InterruptionScope(const InterruptionScope&) = delete;
  InterruptionScope& operator=(const InterruptionScope&) = delete;

 private:
  void (*before_)();
};

}  // namespace sublimit
