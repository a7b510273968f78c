// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the benchmarks that take turns share: threads, clock, the machine's own speed, the command line.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <sched.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

namespace sublimit::bench {

inline std::vector<int> thread_counts() {
  const int all = tbb::info::default_concurrency();
  return all == 1 ? std::vector<int>{1} : std::vector<int>{1, all};
}

/// A number of threads for us; one thread is pinned, so that the scheduler does not move it.
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

/// Of the calling thread alone: what other programs on the machine take is left out.
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

/// Bytes per second of writing memory that is there already.
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

/// The number after `--ratios` (5 if there is none), 0 without it. `--keep-memory`: freed memory stays with the
/// process.
inline int repetitions_of_ratios(int argc, char** argv) {
  int repetitions = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--ratios") {
      repetitions = 5;
    } else if (argument == "--keep-memory") {
      mallopt(M_MMAP_MAX, 0);
      mallopt(M_TRIM_THRESHOLD, INT_MAX);
    } else if (repetitions) {
      repetitions = std::stoi(argument);
    }
  }
  return repetitions;
}

/// Runs what is registered under Google Benchmark's own options. What was registered must live as long.
/// @return  the exit status
inline int run_benchmarks(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace sublimit::bench
