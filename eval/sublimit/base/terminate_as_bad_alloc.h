// SPDX-License-Identifier: Apache-2.0
#pragma once
// Libraries of others throw exceptions of their own for a lack of memory, in destructors and initialisers too, where
// none may get out and std::terminate is called.
#include <cstdlib>
#include <exception>
#include <new>

namespace sublimit {

/// As long as one lives, std::terminate gives what `is_lack` knows to the handler of before as std::bad_alloc. One at a
/// time in a program.
/// @param is_lack  whether the exception that is handled, which it throws again, is a lack of memory
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
