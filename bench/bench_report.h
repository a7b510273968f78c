// SPDX-License-Identifier: Apache-2.0
#pragma once
// Common parts of benchmarks that measure several contenders in turns: the command line, the turns, and the
// report. It is printed row by row and, with `--json FILE`, also written for programs (bench/run_all):
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

enum class Role { ours, peer, shown };  ///< `shown`: printed, but not part of ratios

struct Contender {
  std::string name;
  Role role = Role::ours;
  std::function<double()> seconds;  ///< runs the work once and returns its time in seconds
};

/// A piece of work on a mesh.
struct Work {
  std::string work, mesh, detail;  ///< "apply", "torus", "level 3"
  int threads = 1;
  std::string unit = "ms";
  double scale = 1e3;  ///< units per second
};

class Report {
 public:
  /// Reads `--ratios [N = 5] --json FILE --only TEXT --threads N --quick --keep-memory`, and removes them from
  /// the arguments.
  Report(std::string program, int& argc, char** argv);

  /// Takes turns even if `--ratios` is not given, for programs that do nothing else.
  /// @param turns  number of turns if `--ratios` gives none
  void take_turns(int turns);
  /// Returns the number of turns; 0: run Google Benchmark instead, with its options.
  int turns() const { return turns_; }
  /// Returns true if meshes should be small, to test only that the program runs.
  bool quick() const { return quick_; }
  /// Returns the numbers of threads to measure with: 1 and all, or the one given.
  const std::vector<int>& threads() const { return threads_; }
  /// Returns true if a work is selected by `--only`, whose text is a part of "work mesh detail". Without mesh
  /// or detail: true if some of the work may be selected.
  bool wants(const std::string& work, const std::string& mesh = {}, const std::string& detail = {}) const;

  /// Lets all contenders take turns, of which the first only warms up, then prints and keeps a row.
  /// @param turns  number of turns; 0: `turns()`
  void measure(const Work& work, const std::vector<Contender>& contenders, int turns = 0);
  /// Values of a contender that were measured otherwise, one for each turn, in `Work::unit`.
  struct Values {
    std::string name;
    Role role = Role::ours;
    std::vector<double> values;  ///< not empty
  };
  void add(const Work& work, const std::vector<Values>& values);
  /// Keeps a number that does not depend on time, for comparison between versions.
  void count(const std::string& of, const std::string& what, double number) { counts_[of][what] = number; }

  /// Writes the JSON if `--json` is given.
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
  double bandwidth_ = 0;  ///< bytes per second that one thread can write
  std::vector<Row> rows_;
  std::map<std::string, std::map<std::string, double>> counts_;
};

}  // namespace sublimit::bench
