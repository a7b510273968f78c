// SPDX-License-Identifier: Apache-2.0
#pragma once
// Many tables: a manifest of jobs, a JSON object a line, of which a machine of a farm does a share.
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
/// @throws FormatError  lines that are no jobs, two jobs with one output; with file:line;  IoError
std::vector<ManifestJob> read_manifest(const std::string& path, const BakeJob& defaults);

/// `3/8`: the third of eight shares, every eighth job from the third on.
struct Shard {
  std::int64_t number = 1, count = 1;
  bool has(size_t job) const { return static_cast<std::int64_t>(job) % count == number - 1; }
};
/// @throws InvalidOption
Shard parse_shard(const std::string& text);

/// Does the jobs of a share one after the other; one that fails does not stop the others.
/// @param log  a file that gets a JSON object a line for each job; empty: none
/// @param dictionary  as of `Dictionaries`, written after every job that has taught something
/// @return     the highest exit status of a job
int bake_manifest(const std::string& path, const Shard& shard, const std::string& log, const std::string& dictionary,
                  const BakeJob& defaults);

}  // namespace sublimit::cli
