// SPDX-License-Identifier: Apache-2.0
#pragma once
// Faces between the points of a shard: points on their sides may be those of other shards.
#include "sublimit/stencils/bake/detail/bake_patterns.h"
#include "sublimit/stencils/shards/mesh_part.h"

namespace sublimit {

/// @param lattices  of the part, with a ring more around it than `shard_rings`
/// @param points    of each face of the part, its own or not: where its points begin in the whole, how many they are
/// @return  over points of the whole, of which there are no more than numbers of 32 bits; of own faces in their order,
///          those of holes left out
/// @throws AnalysisError  faces beside own ones have other points here than there
FaceList faces_between(PartLattices lattices, const MeshPart& part,
                       std::span<const std::array<std::int64_t, 2>> points);

}  // namespace sublimit
