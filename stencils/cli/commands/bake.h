// SPDX-License-Identifier: Apache-2.0
#pragma once
// Jobs that bake a table, from a command line (bake.cpp) or from a manifest of many jobs (bake_manifest.cpp).
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "support/common.h"
#include "sublimit/stencils/bake/detail/bake.h"

namespace sublimit::cli {

struct BakeJob {
  Common common;
  // Exactly one of these four gives the points.
  std::optional<int> levels;
  std::optional<int> grid;   ///< points on each side of a face
  std::string at;            ///< a CSV of places; empty: not given
  std::string tessellation;  ///< a .ply with places; empty: not given

  bool limit = false;              ///< limits of the vertices of `levels` instead of the level
  int derivatives = 0;             ///< 0, 1 or 2
  bool tags = false;               ///< store the creases and corners that are left on the level
  bool is_float = true;            ///< weights in float, otherwise in double
  bool is_plan = false;            ///< only predict size and memory; make no table
  double memory_limit = INFINITY;  ///< bytes
  std::string output;
};

/// Checks the options of a job.
/// @throws InvalidOption  options that contradict each other
void check(const BakeJob& job);

/// Dictionaries of the types of neighbourhoods, one for each scheme and its options. Jobs share them, and files
/// keep them for later runs, if a path is given.
class Dictionaries {
 public:
  /// @param path  a file for a single scheme, or a directory with a file for each scheme; empty: nothing is
  ///              kept
  explicit Dictionaries(std::string path = "") : path_(std::move(path)) {}
  /// Returns the dictionary of a scheme, read from its file if that exists.
  /// @throws IoError, FormatError  a file that is not a dictionary of this scheme
  /// @throws InvalidOption         a second scheme, if the path is a file
  Patterns& of(const Scheme<double>& scheme, const SchemeOptions& options);
  /// Writes the dictionaries that have new entries.
  void save();

 private:
  struct Entry {
    std::unique_ptr<Patterns> patterns;
    std::filesystem::path file;
    size_t num_saved = 0;  // matrices in the file
  };
  std::string path_;
  std::map<std::pair<std::string, SchemeOptions>, Entry> entries_;
};

struct BakeOutcome {
  BakeStatistics statistics;
  Index control_points = 0;
  std::int64_t file_bytes = 0;
  std::optional<BakePlan> plan;  ///< set if the job has a memory limit or only asks for the plan
  bool was_there = false;        ///< true if a valid table of the same job was kept
};

/// Bakes a table and writes its file.
/// @param keep  keep the file if it is a valid table of the same job
BakeOutcome bake_table(const BakeJob& job, Dictionaries& dictionaries, Progress& progress, bool keep = false);

/// Returns the method and size of a table in words.
std::string in_words(const BakeStatistics& statistics);

}  // namespace sublimit::cli
