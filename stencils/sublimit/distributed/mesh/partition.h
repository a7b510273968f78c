// SPDX-License-Identifier: Apache-2.0
#pragma once
// Division of the faces of a mesh into parts of nearly equal size, with few edges between parts.
#include "sublimit/distributed/mesh/incidence.h"

namespace sublimit {

/// Returns the part of each face of this rank's run, computed by PT-Scotch from the graph of faces that share
/// edges. The division may differ from run to run. Collective: all ranks call.
/// @note  PETSc's MatPartitioning is not used: Debian 12 compiles its PETSc of 64-bit indices against the
///        PT-Scotch of 32-bit numbers, which then reads each index as two numbers, and crashes. The PT-Scotch
///        here has 64 bits.
/// Source: Chevalier, Pellegrini 2008, "PT-Scotch: a tool for efficient parallel graph ordering".
/// @throws ResourceError, AnalysisError  on all ranks
std::vector<int> partition(const Ranks& ranks, const SpreadMesh& mesh, const Incidence& incidence, int parts);

/// Returns the part of each face of this rank's run if parts are consecutive faces in the order of the file.
/// Needs no graph.
std::vector<int> equal_runs(const Ranks& ranks, const SpreadMesh& mesh, int parts);

/// Returns the rank that has a part: ranks have consecutive parts, as equal in number as possible.
inline int rank_of_part(const Ranks& ranks, int part, int parts) {
  return static_cast<int>(((std::int64_t{part} + 1) * ranks.size() - 1) / parts);
}

/// Returns the faces of each part of this rank, ascending. Collective: all ranks call.
/// @param part  part of each face of this rank's run
std::vector<std::vector<std::int64_t>> owned_faces(const Ranks& ranks, const SpreadMesh& mesh,
                                                   const std::vector<int>& part, int parts);

}  // namespace sublimit
