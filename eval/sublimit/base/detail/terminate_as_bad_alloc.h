// SPDX-License-Identifier: Apache-2.0
#pragma once
// Some libraries throw exceptions of their own if memory is exhausted, also in destructors and initialisers, where
// std::terminate is called.
#include <cstdlib>
#include <exception>
#include <new>

namespace sublimit {

/// A terminate handler that replaces such exceptions by std::bad_alloc before it calls the previous handler. A program
/// may have one at a time.
/// @tparam is_lack  returns true if the current exception, which it rethrows, means that memory is exhausted
template <bool (*is_lack)()>
class TerminateAsBadAlloc {
 public:
  TerminateAsBadAlloc() {
    before_ = std::get_terminate();
    std::set_terminate(end);
  }
  TerminateAsBadAlloc(const TerminateAsBadAlloc&) = delete;
  TerminateAsBadAlloc& operator=(const TerminateAsBadAlloc&) = delete;
  ~TerminateAsBadAlloc() { std::set_terminate(before_); }

 private:
  [[noreturn]] static void end() {
    if (std::current_exception() && is_lack()) {
      try {
        throw std::bad_alloc();
      } catch (...) {
        before_();
      }
    }
    before_();
    std::abort();
  }
  static inline std::terminate_handler before_ = nullptr;
};

}  // namespace sublimit
