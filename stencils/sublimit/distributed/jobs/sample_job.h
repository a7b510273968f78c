// SPDX-License-Identifier: Apache-2.0
#pragma once
// Samples of the limit of a mesh that no process has whole, into a file as `sublimit sample` writes it
// (sample_files.h): places go to the ranks that own their faces, what is found there comes back, batch by batch.
#include <memory>
#include <optional>

#include "sublimit/distributed/jobs/shard_jobs.h"
#include "sublimit/stencils/files/sample_files.h"

namespace sublimit {

struct SampleRequest {
  // One of these three says where.
  std::filesystem::path at;                ///< a CSV; empty: not given
  std::optional<int> grid;                 ///< samples a side, 2 at least
  std::optional<std::int64_t> num_random;  ///< 0 at least
  std::uint64_t seed = 0;                  ///< of random ones
  bool clamp = false;                      ///< places of `at` outside their face are moved to its rim
  SampleColumns columns;
  std::filesystem::path output;
};

struct SamplesMade {
  SampleSummary summary;
  std::int64_t num_clamped = 0;
};

/// The same bytes as one process writes.
/// @param reader  of `at`, on the first rank
/// @throws FormatError          on all ranks, like all that follows: as `SampleReader`, naming the row
/// @throws UnsupportedTopology  faces that the scheme cuts first only where not all have four corners, as parts do not
/// see
/// @throws ResourceError        more samples than the disk has room for; more faces than places can have by 32 bits
/// @throws AnalysisError        no limit
SamplesMade write_samples(const Ranks& ranks, const SpreadJob& job, const SampleRequest& request, SampleReader* reader,
                          const Told& told);

}  // namespace sublimit
