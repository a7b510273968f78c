// SPDX-License-Identifier: Apache-2.0
#pragma once
// Samples of the limit of a mesh that no process has whole, written to a file as `sublimit sample` writes it
// (sample_files.h). Batch by batch, places go to the ranks that own their faces, and the results come back.
#include <memory>
#include <optional>

#include "sublimit/distributed/jobs/shard_jobs.h"
#include "sublimit/stencils/files/sample_files.h"

namespace sublimit {

struct SampleRequest {
  // Exactly one of these three gives the places.
  std::filesystem::path at;                ///< a CSV; empty: not given
  std::optional<int> grid;                 ///< samples on each side of a face, >= 2
  std::optional<std::int64_t> num_random;  ///< number of random samples, >= 0
  std::uint64_t seed = 0;                  ///< seed of random samples
  bool clamp = false;                      ///< move places of `at` outside their face to its boundary
  SampleColumns columns;
  std::filesystem::path output;
};

struct SamplesMade {
  SampleSummary summary;
  std::int64_t num_clamped = 0;
};

/// Evaluates the samples of a request and writes them: the same bytes as one process writes. Collective: all
/// ranks call.
/// @param reader  reader of `at` on the first rank, else null
/// All errors are thrown on all ranks:
/// @throws FormatError          as `SampleReader`, naming the row
/// @throws UnsupportedTopology  a scheme that first cuts faces if not all of the mesh have four corners (a part
///                              does not know the faces of the others), on a mesh with other faces
/// @throws ResourceError        more samples than the disk has room for; more faces than 32-bit numbers count
/// @throws AnalysisError        a place without a limit
SamplesMade write_samples(const Ranks& ranks, const SpreadJob& job, const SampleRequest& request, SampleReader* reader,
                          const Told& told);

}  // namespace sublimit
