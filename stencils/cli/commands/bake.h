// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables to make, for a command line (bake.cpp) and a manifest of many (bake_manifest.cpp).
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
  // One of these four says which points.
  std::optional<int> levels;
  std::optional<int> grid;   ///< places a side
  std::string at;            ///< a CSV of places; empty: not given
  std::string tessellation;  ///< a .ply with places; empty: not given

  bool limit = false;              ///< limits of the vertices of `levels`
  int derivatives = 0;             ///< 0, 1 or 2
  bool tags = false;               ///< those that are left, too
  bool is_float = true;            ///< weights; else double
  bool is_plan = false;            ///< no table, but what it would be
  double memory_limit = INFINITY;  ///< bytes
  std::string output;
};

/// @throws InvalidOption  options that do not go together
void check(const BakeJob& job);

/// Types of neighbourhoods by scheme and options, shared between jobs, and kept from run to run if there is a place.
class Dictionaries {
 public:
  /// @param path  a file, or a directory with one for each scheme and its options; empty: nothing is kept
  explicit Dictionaries(std::string path = "") : path_(std::move(path)) {}
  /// @throws IoError, FormatError  a file that is there and no dictionary of this scheme
  Patterns& of(const Scheme<double>& scheme, const SchemeOptions& options);
  /// Writes those that have learned something.
  void save();

 private:
  struct Entry {
    std::unique_ptr<Patterns> patterns;
    std::filesystem::path file;
    size_t num_saved = 0;  // matrices
  };
  std::string path_;
  std::map<std::pair<std::string, SchemeOptions>, Entry> entries_;
};

struct BakeOutcome {
  BakeStatistics statistics;
  Index control_points = 0;
  std::int64_t file_bytes = 0;
  std::optional<BakePlan> plan;  ///< plan of jobs with a memory limit, and if it was asked for
  bool was_there = false;        ///< a valid table of the same job, which stays
};

/// Makes a table, and its file.
/// @param keep  a valid table of the same job that is there already stays
BakeOutcome bake_table(const BakeJob& job, Dictionaries& dictionaries, Progress& progress, bool keep = false);

/// Returns the method and size of a table in words.
std::string in_words(const BakeStatistics& statistics);

}  // namespace sublimit::cli
