// SPDX-License-Identifier: Apache-2.0
#pragma once
// The peak memory of this process, since its start or since the last reset.
#include <sys/resource.h>

#include <cstdint>
#include <fstream>
#include <string>

namespace sublimit::cli {

/// Resets the peak; on systems that cannot, it counts from the start of the process.
inline void forget_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// Returns the peak memory of the process in bytes.
inline std::int64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stoll(line.substr(6)) * 1024;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

}  // namespace sublimit::cli
