// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which part has which face: as many each, with few neighbours elsewhere.
#include "sublimit/distributed/mesh/incidence.h"

namespace sublimit {

/// The part of each face of the own run: by PT-Scotch, from the graph of faces that share edges. It may be another one
/// each time.
/// @note  Not through PETSc's MatPartitioning: Debian 12 compiles its PETSc of 64-bit indices against the PT-Scotch of
///        32-bit numbers, which then reads indices as twice as many, and crashes. This is the one of 64 bits.
/// Source: Chevalier, Pellegrini 2008, "PT-Scotch: a tool for efficient parallel graph ordering".
/// @throws ResourceError, AnalysisError  on all ranks
std::vector<int> partition(const Ranks& ranks, const SpreadMesh& mesh, const Incidence& incidence, int parts);

/// Runs of faces as the file has them: no graph is made.
std::vector<int> equal_runs(const Ranks& ranks, const SpreadMesh& mesh, int parts);

/// Which rank has a part: ranks have parts one after the other, as equally many as can be.
inline int rank_of_part(const Ranks& ranks, int part, int parts) {
  return static_cast<int>(((std::int64_t{part} + 1) * ranks.size() - 1) / parts);
}

/// Faces of each part of this rank, ascending.
/// @param part  of each face of the own run
std::vector<std::vector<std::int64_t>> owned_faces(const Ranks& ranks, const SpreadMesh& mesh,
                                                   const std::vector<int>& part, int parts);

}  // namespace sublimit
