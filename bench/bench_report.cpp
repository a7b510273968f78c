// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include <malloc.h>

#include <algorithm>
#include <cctype>
#include <climits>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "measuring.h"

namespace sublimit::bench {

Report::Report(std::string program, int& argc, char** argv) : program_(std::move(program)), threads_(thread_counts()) {
  int kept = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const bool has_value = i + 1 < argc,
               has_number = has_value && std::isdigit(static_cast<unsigned char>(*argv[i + 1]));
    if (name == "--ratios") {
      turns_ = has_number ? std::stoi(argv[++i]) : 5;
    } else if (name == "--json" && has_value) {
      json_ = argv[++i];
    } else if (name == "--only" && has_value) {
      only_ = argv[++i];
    } else if (name == "--threads" && has_number) {
      threads_ = {std::stoi(argv[++i])};
    } else if (name == "--quick") {
      quick_ = true;
    } else if (name == "--keep-memory") {
      keep_memory_ = true;
      mallopt(M_MMAP_MAX, 0);
      mallopt(M_TRIM_THRESHOLD, INT_MAX);
    } else {
      argv[kept++] = argv[i];
    }
  }
  argc = kept;
  if (turns_ > 0) take_turns(turns_);
}

void Report::take_turns(int turns) {
  if (bandwidth_ > 0) return;
  turns_ = turns;
  bandwidth_ = write_bandwidth();
  std::printf("write bandwidth, one thread: %.1f GB/s; medians of %d turns (least..most)%s\n", bandwidth_ / 1e9, turns_,
              keep_memory_ ? "; freed memory is kept" : "");
#ifndef NDEBUG
  std::printf("assertions are on: these are not the figures of a release build\n");
#endif
}

bool Report::wants(const std::string& work, const std::string& mesh, const std::string& detail) const {
  std::string name = work;
  for (const std::string& part : {mesh, detail}) {
    if (part.empty()) return true;
    name += " " + part;
  }
  return name.find(only_) != std::string::npos;
}

void Report::measure(const Work& work, const std::vector<Contender>& contenders, int turns) {
  if (!wants(work.work, work.mesh, work.detail)) return;
  std::vector<Values> all;
  for (const Contender& c : contenders) all.push_back({c.name, c.role, {}});
  for (int turn = 0; turn <= std::max(1, turns == 0 ? turns_ : turns); ++turn)
    for (size_t i = 0; i < contenders.size(); ++i) {
      const double time = work.scale * contenders[i].seconds();
      if (turn > 0) all[i].values.push_back(time);
    }
  add(work, all);
}

void Report::add(const Work& work, const std::vector<Values>& values) {
  Row row{work, {}};
  for (const Values& v : values) {
    std::vector<double> t = v.values;
    std::sort(t.begin(), t.end());
    row.times.push_back({v.name, v.role, t[t.size() / 2], t.front(), t.back()});
  }
  print(row);
  rows_.push_back(std::move(row));
}

void Report::print(const Row& row) {
  const Work& w = row.work;
  std::printf("%-24s%-18s%-12s %d thr, %-9s", w.work.c_str(), w.mesh.c_str(), w.detail.c_str(), w.threads,
              w.unit.c_str());
  double best = INFINITY;
  for (const Time& t : row.times) {
    std::printf("  %s %.4g (%.4g..%.4g)", t.name.c_str(), t.median, t.least, t.most);
    if (t.role == Role::peer) best = std::min(best, t.median);
  }
  if (best < INFINITY) {
    std::printf("  best peer : ours");
    for (const Time& t : row.times)
      if (t.role == Role::ours) std::printf(" %.2f", best / t.median);
  }
  std::printf("\n");
  std::fflush(stdout);
}

int Report::finish() const {
  if (json_.empty()) return 0;
  using nlohmann::ordered_json;
  constexpr const char* roles[] = {"ours", "peer", "shown"};
  ordered_json rows = ordered_json::array();
  for (const Row& row : rows_) {
    const Work& w = row.work;
    ordered_json times = ordered_json::array();
    for (const Time& t : row.times)
      times.push_back({{"name", t.name},
                       {"role", roles[size_t(t.role)]},
                       {"median", t.median},
                       {"least", t.least},
                       {"most", t.most}});
    rows.push_back({{"work", w.work},
                    {"mesh", w.mesh},
                    {"detail", w.detail},
                    {"threads", w.threads},
                    {"unit", w.unit},
                    {"times", times}});
  }
#ifdef NDEBUG
  constexpr bool assertions = false;
#else
  constexpr bool assertions = true;
#endif
  const ordered_json all{{"program", program_},
                         {"compiler", __VERSION__},
                         {"flags", SUBLIMIT_BENCH_FLAGS},
                         {"assertions", assertions},
                         {"turns", turns_},
                         {"keep memory", keep_memory_},
                         {"quick", quick_},
                         {"write bandwidth", bandwidth_},
                         {"rows", rows},
                         {"counts", counts_}};
  std::ofstream file(json_);
  file << all.dump(1) << "\n";
  if (file.flush()) return 0;
  std::fprintf(stderr, "%s: cannot write %s\n", program_.c_str(), json_.c_str());
  return 3;
}

}  // namespace sublimit::bench
