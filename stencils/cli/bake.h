// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables to make, for a command line (bake.cpp) and a manifest of many (bake_manifest.cpp).
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "common.h"
#include "sublimit/bake.h"

namespace sublimit::cli {

struct BakeJob {
  Common common;
  // One of these three says which points.
  std::optional<int> levels;
  std::optional<int> grid;  ///< places a side
  std::string at;           ///< a CSV of places; empty: not given

  bool limit = false;              ///< of `levels`
  int derivatives = 0;             ///< 0, 1 or 2
  bool is_float = true;            ///< weights; else double
  bool is_plan = false;            ///< no table, but what it would be
  double memory_limit = INFINITY;  ///< bytes
  std::string output;
};

/// @throws InvalidOption  options that do not go together
void check(const BakeJob& job);

/// Types of neighbourhoods by scheme and options, shared between jobs.
class Dictionaries {
 public:
  Patterns& of(const Scheme<double>& scheme, const SchemeOptions& options);

 private:
  std::map<std::pair<std::string, SchemeOptions>, std::unique_ptr<Patterns>> patterns_;
};

struct BakeOutcome {
  BakeStatistics statistics;
  Index control_points = 0;
  std::int64_t file_bytes = 0;
  std::optional<BakePlan> plan;  ///< of jobs with a limit, and if it was asked for
  bool was_there = false;        ///< a valid table of the same job, which stays
};

/// Makes a table, and its file.
/// @param keep  a valid table of the same job that is there already stays
BakeOutcome bake_table(const BakeJob& job, Dictionaries& dictionaries, Progress& progress, bool keep = false);

/// What was chosen, and what it takes, in words.
std::string in_words(const BakeStatistics& statistics);

}  // namespace sublimit::cli
