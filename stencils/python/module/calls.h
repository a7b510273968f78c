// SPDX-License-Identifier: Apache-2.0
#pragma once
// How the library is called: without Python's lock, and with no more threads than were asked for.
#include <pybind11/pybind11.h>
#include <tbb/global_control.h>

#include <optional>

namespace sublimit::python {

/// Holds what is called to so many threads, as the program's --threads does; 0: all.
class Threads {
 public:
  explicit Threads(int count) {
    if (count > 0) control_.emplace(tbb::global_control::max_allowed_parallelism, size_t(count));
  }

 private:
  std::optional<tbb::global_control> control_;
};

template <class Job>
auto without_gil(const Job& job) {
  const pybind11::gil_scoped_release no_gil;
  return job();
}

}  // namespace sublimit::python
