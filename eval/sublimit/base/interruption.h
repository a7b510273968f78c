// SPDX-License-Identifier: Apache-2.0
#pragma once
// A caller's way out of long work, such as Ctrl-C: between blocks of its loops (parallel_for.h) the thread that began
// the work calls what the caller has set, which may throw. The loop then ends as it does for any error.

namespace sublimit {

namespace detail {
using Check = void();
inline constinit thread_local Check* interruption = nullptr;
}  // namespace detail

inline void check_interruption() {
  if (detail::interruption) detail::interruption();
}

/// For as long as it lives, and for work that this thread begins.
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
