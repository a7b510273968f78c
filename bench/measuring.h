// SPDX-License-Identifier: Apache-2.0
#pragma once
// Common parts of the benchmarks: numbers of threads, clocks, memory, the write bandwidth of the machine.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <sched.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

namespace sublimit::bench {

inline std::vector<int> thread_counts() {
  const int all = tbb::info::default_concurrency();
  return all == 1 ? std::vector<int>{1} : std::vector<int>{1, all};
}

/// Scope that limits the threads of this library. A single thread is pinned, so that the scheduler does not
/// move it.
class Threads {
 public:
  explicit Threads(int count) : limit_(tbb::global_control::max_allowed_parallelism, size_t(count)) {
    sched_getaffinity(0, sizeof before_, &before_);
    if (count > 1) return;
    cpu_set_t last;
    CPU_ZERO(&last);
    for (int cpu = CPU_SETSIZE - 1; cpu >= 0 && CPU_COUNT(&last) == 0; --cpu)
      if (CPU_ISSET(cpu, &before_)) CPU_SET(cpu, &last);
    sched_setaffinity(0, sizeof last, &last);
  }
  ~Threads() { sched_setaffinity(0, sizeof before_, &before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  tbb::global_control limit_;
  cpu_set_t before_;
};

inline double seconds(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Returns the CPU time of the calling thread in seconds, which other programs on the machine do not affect.
inline double cpu_seconds(const auto& work) {
  const auto now = [] {
    timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  };
  const double start = now();
  work();
  return now() - start;
}

/// Returns the CPU time of work on one thread, or the wall time of work on several threads.
inline double timed(int threads, const auto& work) { return threads == 1 ? cpu_seconds(work) : seconds(work); }

/// Returns the bytes per second of writing to memory that is already mapped.
inline double write_bandwidth() {
  std::vector<char> block(size_t{1} << 28, 1);
  double best = 0;
  for (int i = 0; i < 5; ++i)
    best = std::max(best, double(block.size()) / seconds([&] {
                            std::memset(block.data(), i, block.size());
                            benchmark::DoNotOptimize(block.data());
                            benchmark::ClobberMemory();
                          }));
  return best;
}

/// Returns the peak resident set of the process in bytes since the last call of `forget_peak_bytes`.
inline double peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::atof(line.c_str() + 6);
  return 0;
}
/// Resets the peak.
/// @return  current resident set in bytes
inline double forget_peak_bytes() {
  malloc_trim(0);  // returns freed memory to the system, so that using it again counts
  std::ofstream("/proc/self/clear_refs") << 5;
  return peak_bytes();
}

inline void register_write_bandwidth() {
  benchmark::RegisterBenchmark("BM_WriteBandwidth", [](benchmark::State& state) {
    std::vector<char> block(size_t{1} << 28, 1);
    for (auto _ : state) {
      std::memset(block.data(), int(state.iterations()), block.size());
      benchmark::DoNotOptimize(block.data());
      benchmark::ClobberMemory();
    }
    state.SetBytesProcessed(state.iterations() * std::int64_t(block.size()));
  });
}

/// Runs the registered benchmarks with Google Benchmark's options. Objects that they refer to must still exist.
/// @return  the exit status
inline int run_benchmarks(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace sublimit::bench
