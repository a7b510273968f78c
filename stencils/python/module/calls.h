// SPDX-License-Identifier: Apache-2.0
#pragma once
// How the library is called: without Python's lock, with Ctrl-C looked for, and with no more threads than were asked
// for.
#include <pybind11/pybind11.h>
#include <tbb/global_control.h>

#include <chrono>
#include <optional>

#include "sublimit/base/detail/interruption.h"

namespace sublimit::python {

/// Raises what a signal's handler raises: Python calls handlers on its main thread alone.
inline void check_signals() {
  using Clock = std::chrono::steady_clock;
  static thread_local Clock::time_point last;
  const Clock::time_point now = Clock::now();
  if (now - last < std::chrono::milliseconds(50)) return;
  last = now;
  const pybind11::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
}

/// Holds what is called to so many threads, as the program's --threads does; 0: all.
class Threads {
 public:
  explicit Threads(int count) {
    if (count > 0) control_.emplace(tbb::global_control::max_allowed_parallelism, size_t(count));
  }

 private:
  std::optional<tbb::global_control> control_;
};

/// Around every call that may take long.
struct LongCall {
  pybind11::gil_scoped_release no_gil{};
  InterruptionScope signals{check_signals};
};

template <class Job>
auto without_gil(const Job& job) {
  const LongCall scope;
  return job();
}

}  // namespace sublimit::python
