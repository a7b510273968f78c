// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sizes before memory is taken: what a job will need, against what the machine has.
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

/// The least that the control groups of this process (of a container, a batch job) allow; infinity if none says so.
/// @param root  of the file system; tests have one of their own
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

/// What the machine has, or the control groups of this process if that is less.
inline double physical_memory() {
  static const double bytes =
      std::min(static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE)),
               control_group_memory());
  return bytes;
}

namespace detail {
inline std::atomic<double> memory_limit{std::numeric_limits<double>::infinity()};
}
/// Holds the jobs of this process to so many bytes, where what they take is predicted.
inline void limit_memory(double bytes) { detail::memory_limit = bytes; }
/// Bytes that a job may take: what it was held to, else what the machine has, less a sixteenth for all else there.
inline double memory_limit() {
  const double given = detail::memory_limit.load();
  return std::isfinite(given) ? std::min(given, physical_memory()) : physical_memory() * 15 / 16;
}

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

/// `this machine has 16.0 GB, 15.0 GB of it for a job`, or `the limit is 1.0 GB`.
inline std::string memory_limit_in_words() {
  const std::string limit = bytes_in_words(memory_limit());
  if (std::isfinite(detail::memory_limit.load())) return "the limit is " + limit;
  return "this machine has " + bytes_in_words(physical_memory()) + ", " + limit + " of it for a job";
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
