// SPDX-License-Identifier: Apache-2.0
#pragma once
// Many tables: a manifest of jobs with a JSON object on each line. Several machines can each do a share of it.
//
//     {"mesh": "car.obj", "scheme": "catmull-clark", "levels": 3, "output": "tables/car.safetensors"}
//     {"mesh": "pot.obj", "scheme": "loop", "triangulate": true, "grid": 9, "derivatives": 1, "precision": "double",
//      "options": {"...": "..."}, "output": "tables/pot.safetensors"}
//
// Keys are the names of the command line's options; paths are relative to the manifest. Empty lines are skipped.
#include <string>
#include <vector>

#include "commands/bake.h"

namespace sublimit::cli {

struct ManifestJob {
  std::int64_t line = 0;  ///< line of the manifest, from 1
  BakeJob job;
};

/// Reads all jobs of a manifest.
/// @param defaults  values of fields that lines do not set: threads, quiet, limits
/// @throws FormatError  a line that is not a job, two jobs with the same output; the message has file and line
/// @throws IoError      missing, unreadable
std::vector<ManifestJob> read_manifest(const std::string& path, const BakeJob& defaults);

/// A share of the jobs: `3/8` is the third of eight shares, that is every eighth job from the third on.
struct Shard {
  std::int64_t number = 1, count = 1;
  bool has(size_t job) const { return static_cast<std::int64_t>(job) % count == number - 1; }
};
/// Reads a share such as `3/8`.
/// @throws InvalidOption  another text
Shard parse_shard(const std::string& text);

/// Runs the jobs of a share one after the other. A job that fails does not stop the others.
/// @param log         file for a log, with a JSON object on a line for each job; empty: no log
/// @param dictionary  path of `Dictionaries`, which are written after every job with new entries
/// @return            the highest exit status of a job
int bake_manifest(const std::string& path, const Shard& shard, const std::string& log, const std::string& dictionary,
                  const BakeJob& defaults);

}  // namespace sublimit::cli
