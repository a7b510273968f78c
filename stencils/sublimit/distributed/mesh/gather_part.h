// SPDX-License-Identifier: Apache-2.0
#pragma once
// A part of a mesh that no process has whole, with the rings around it: the same as `mesh_part` makes from a
// whole mesh, and with texture coordinates.
#include "sublimit/distributed/mesh/incidence.h"
#include "sublimit/stencils/shards/mesh_part.h"

namespace sublimit {

/// Returns a part with the rings of faces around it. Collective: all ranks call, each for one of its parts, or
/// with `owned` empty.
/// @param owned  faces of the part, ascending
/// @param rings  number of rings around the owned faces
/// @param isolated  true: the part also has all isolated vertices of the mesh
/// @throws ResourceError  on all ranks: a part with more corners of faces or vertices than 32-bit indices count
MeshPart gather_part(const Ranks& ranks, const SpreadMesh& mesh, const Incidence& incidence,
                     std::span<const std::int64_t> owned, int rings, bool isolated);

}  // namespace sublimit
