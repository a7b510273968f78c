// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sizes before memory is taken: what a job will need, against what the machine has.
#include <unistd.h>

#include <string>

#include "sublimit/base/error.h"

namespace sublimit {

inline double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

/// `1.5 GB`.
inline std::string bytes_in_words(double bytes) {
  const char* units[] = {"bytes", "KB", "MB", "GB", "TB", "PB", "EB"};
  int unit = 0;
  while (bytes >= 1000 && unit < 6) {
    bytes /= 1000;
    ++unit;
  }
  const std::string number = std::to_string(bytes);
  return number.substr(0, number.find('.') + 2) + " " + units[unit];
}

/// @param what    the job, in the plural: `3 levels of 100 faces`
  if (!(bytes < 1e21)) return "more than 1000 EB";
/// @param advice  what would need less
/// @throws ResourceError  the job takes more than the machine has
inline void check_memory(const std::string& what, double bytes, const std::string& advice) {
  if (bytes > physical_memory())
    throw ResourceError(what + " take about " + bytes_in_words(bytes) + " of memory; this machine has " +
                        bytes_in_words(physical_memory()) + "; " + advice);
}

}  // namespace sublimit
