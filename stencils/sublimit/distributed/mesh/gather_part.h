// SPDX-License-Identifier: Apache-2.0
#pragma once
// A part of a mesh that no process has whole, with its rings: as `mesh_part` makes it of a whole one,
// and with texture coordinates.
#include "sublimit/distributed/mesh/incidence.h"
#include "sublimit/stencils/shards/mesh_part.h"

namespace sublimit {

/// All ranks call, each for a part of its own, or for none.
/// @param owned  faces of the part, ascending
/// @param rings  around them
/// @param isolated   whether vertices of no face are in it, of one rank's
/// @throws ResourceError  on all ranks: a part of more than 32-bit indices count
MeshPart gather_part(const Ranks& ranks, const SpreadMesh& mesh, const Incidence& incidence,
                     std::span<const std::int64_t> owned, int rings, bool isolated);

}  // namespace sublimit
