// SPDX-License-Identifier: Apache-2.0
#pragma once
// Checks before memory is taken: the size that a job needs against the memory of the machine.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>

#include "sublimit/base/error.h"

namespace sublimit {

/// Returns the smallest memory limit of the control groups of this process (of a container, a batch job) in bytes;
/// infinity if there is none.
/// @param root  root of the file system, for tests
inline double control_group_memory(const std::string& root = "") {
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const std::string& file) {
    double bytes = 0;
    if (std::ifstream(file) >> bytes && bytes > 0) least = std::min(least, bytes);  // "max" is no number
  };
  std::ifstream groups(root + "/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // 0::/path, or 4:memory:/path of the first version
    const size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    std::string controllers = ",";
    controllers.append(line, first + 1, second - first - 1);
    controllers += ',';
    const bool unified = controllers == ",,";
    if (!unified && controllers.find(",memory,") == std::string::npos) continue;
    const std::string mount = root + (unified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory");
    const std::string name = unified ? "/memory.max" : "/memory.limit_in_bytes";
    std::string path = line.substr(second + 1);
    for (; path.starts_with('/') && path != "/"; path.erase(path.rfind('/'))) look(mount + path + name);
    look(mount + name);
  }
  return least;
}

/// Returns the memory of the machine in bytes, or the limit of this process's control groups if that is less.
inline double physical_memory() {
  static const double bytes =
      std::min(static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE)),
               control_group_memory());
  return bytes;
}

namespace detail {
inline std::atomic<double> memory_limit{std::numeric_limits<double>::infinity()};
}
/// Limits the predicted memory of jobs of this process, in bytes.
inline void limit_memory(double bytes) { detail::memory_limit = bytes; }
/// Returns the bytes that a job may take: the limit that was set, else the machine's memory less a sixteenth.
inline double memory_limit() {
  const double given = detail::memory_limit.load();
  return std::isfinite(given) ? std::min(given, physical_memory()) : physical_memory() * 15 / 16;
}

/// Returns a size as text: `1.5 GB`.
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

/// Returns the limit as text: `this machine has 16.0 GB, 15.0 GB of it for a job`, or `the limit is 1.0 GB`.
inline std::string memory_limit_in_words() {
  const std::string limit = bytes_in_words(memory_limit());
  if (std::isfinite(detail::memory_limit.load())) return "the limit is " + limit;
  return "this machine has " + bytes_in_words(physical_memory()) + ", " + limit + " of it for a job";
}

/// Checks the predicted memory of a job.
/// @param what    the job, in the plural: `3 levels of 100 faces`
/// @param advice  what would take less memory, for the message
/// @throws ResourceError  the job takes more memory than it may
inline void check_memory(const std::string& what, double bytes, const std::string& advice) {
  if (bytes > memory_limit())
    throw ResourceError(what + " take about " + bytes_in_words(bytes) + " of memory; " + memory_limit_in_words() +
                        "; " + advice);
}

}  // namespace sublimit
