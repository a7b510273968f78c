// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sizes before memory is taken: what a job will need, against what the machine has.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>

#include "sublimit/base/error.h"

namespace sublimit {

/// What the machine has, or the control group that this process is in (of a container or a batch job) if that is less.
inline double physical_memory() {
  static const double bytes = [] {
    double least = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    for (const char* path : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
      double limit = 0;
      if (std::ifstream(path) >> limit && limit > 0) least = std::min(least, limit);  // "max" is no number
    }
    return least;
  }();
  return bytes;
}

namespace detail {
inline std::atomic<double> memory_limit{std::numeric_limits<double>::infinity()};
}
/// Holds the jobs of this process to so many bytes, where what they take is predicted.
inline void limit_memory(double bytes) { detail::memory_limit = bytes; }
/// Bytes that a job may take: what the machine has, less a sixteenth for all else that runs there, or what it was held
/// to.
inline double memory_limit() { return std::min(physical_memory() * 15 / 16, detail::memory_limit.load()); }

/// `1.5 GB`.
inline std::string bytes_in_words(double bytes) {
  if (!(bytes < 1e21)) return "more than 1000 EB";
  const char* units[] = {"bytes", "KB", "MB", "GB", "TB", "PB", "EB"};
  int unit = 0;
  while (bytes >= 1000 && unit < 6) {
    bytes /= 1000;
    ++unit;
  }
  const auto tenths = static_cast<std::int64_t>(10 * bytes);
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " " + units[unit];
}

/// `this machine has 16.0 GB`, or `the limit is 1.0 GB`.
inline std::string memory_limit_in_words() {
  const bool is_given = detail::memory_limit < physical_memory() * 15 / 16;
  return (is_given ? "the limit is " : "this machine has ") +
         bytes_in_words(is_given ? memory_limit() : physical_memory());
}

/// @param what    the job, in the plural: `3 levels of 100 faces`
/// @param advice  what would need less
/// @throws ResourceError  the job takes more than the machine has, or than it may
inline void check_memory(const std::string& what, double bytes, const std::string& advice) {
  if (bytes > memory_limit())
    throw ResourceError(what + " take about " + bytes_in_words(bytes) + " of memory; " + memory_limit_in_words() +
                        "; " + advice);
}

}  // namespace sublimit
