// SPDX-License-Identifier: Apache-2.0
#pragma once
// Scopes in which the library is called: Python's lock is released, Ctrl-C is checked, and the number of
// threads is limited.
#include <pybind11/pybind11.h>
#include <tbb/global_control.h>

#include <chrono>
#include <optional>

#include "sublimit/base/detail/interruption.h"

namespace sublimit::python {

/// Runs the handlers of pending signals, and raises their exceptions (KeyboardInterrupt). Checks every 50 ms at
/// most; Python runs handlers on its main thread only.
inline void check_signals() {
  using Clock = std::chrono::steady_clock;
  static thread_local Clock::time_point last;
  const Clock::time_point now = Clock::now();
  if (now - last < std::chrono::milliseconds(50)) return;
  last = now;
  const pybind11::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
}

/// Scope that limits the number of threads, as the program's --threads does; 0: all.
class Threads {
 public:
  explicit Threads(int count) {
    if (count > 0) control_.emplace(tbb::global_control::max_allowed_parallelism, size_t(count));
  }

 private:
  std::optional<tbb::global_control> control_;
};

/// Scope for calls that may take long: releases Python's lock and makes them interruptible.
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
