// SPDX-License-Identifier: Apache-2.0
#pragma once
// What benches that take turns have in common: their command line, the turns, and the report, which is printed row by
// row and, with `--json FILE`, written for programs (bench/run_all) as well.
//
//     {"program": "refine_bench", "compiler": "12.2.0", "flags": "-O3 -DNDEBUG", "assertions": false, "turns": 5,
//      "keep memory": false, "quick": false, "write bandwidth": 9.1e9,
//      "rows": [{"work": "BM_Refine", "mesh": "torus", "detail": "level 2", "threads": 1, "unit": "ms",
//                "times": [{"name": "ours", "role": "ours", "median": 81.2, "least": 80.1, "most": 90.0}, ...]}, ...],
//      "counts": {"table of torus, level 2": {"types": 1, "bytes": 6400000, ...}, ...}}
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace sublimit::bench {

enum class Role { ours, peer, shown };  ///< `shown`: besides, in no ratio

struct Contender {
  std::string name;
  Role role = Role::ours;
  std::function<double()> seconds;  ///< takes a turn
};

/// A piece of work on a mesh.
struct Work {
  std::string work, mesh, detail;  ///< "apply", "torus", "level 3"
  int threads = 1;
  std::string unit = "ms";
  double scale = 1e3;  ///< units a second
};

class Report {
 public:
  /// Reads `--ratios [N = 5] --json FILE --only TEXT --threads N --quick --keep-memory` out of the arguments and leaves
  /// the others.
  Report(std::string program, int& argc, char** argv);

  /// Takes turns though `--ratios` is not given: for programs that do nothing else.
  /// @param turns  as many, or those of `--ratios`
  void take_turns(int turns);
  /// Turns to take; 0: not asked for, Google Benchmark's own options hold.
  int turns() const { return turns_; }
  /// Meshes are to be small: to see that all runs.
  bool quick() const { return quick_; }
  /// Numbers of threads to measure with: 1 and all, or the one given.
  const std::vector<int>& threads() const { return threads_; }
  /// `--only` names a part of "work mesh detail": whether this is the work, or may be some of it.
  bool wants(const std::string& work, const std::string& mesh = {}, const std::string& detail = {}) const;

  /// Lets all take turns, the first of which warms up, and prints and keeps a row.
  /// @param turns  0: as many as were asked for
  void measure(const Work& work, const std::vector<Contender>& contenders, int turns = 0);
  /// What was measured otherwise: all turns of each contender, as `Work::scale` has it.
  struct Values {
    std::string name;
    Role role = Role::ours;
    std::vector<double> values;  ///< not empty
  };
  void add(const Work& work, const std::vector<Values>& values);
  /// Keeps a number that no clock has touched, for comparison between versions.
  void count(const std::string& of, const std::string& what, double number) { counts_[of][what] = number; }

  /// Writes the JSON, if asked for.
  /// @return  the exit status
  int finish() const;

 private:
  struct Time {
    std::string name;
    Role role;
    double median, least, most;
  };
  struct Row {
    Work work;
    std::vector<Time> times;
  };
  static void print(const Row& row);

  std::string program_, json_, only_;
  int turns_ = 0;
  bool quick_ = false, keep_memory_ = false;
  std::vector<int> threads_;
  double bandwidth_ = 0;  ///< bytes per second that one thread writes
  std::vector<Row> rows_;
  std::map<std::string, std::map<std::string, double>> counts_;
};

}  // namespace sublimit::bench
