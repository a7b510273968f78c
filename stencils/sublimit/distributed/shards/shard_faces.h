// SPDX-License-Identifier: Apache-2.0
#pragma once
// Faces between the points of a shard. Points on their sides may belong to other shards.
#include "sublimit/stencils/bake/detail/bake_patterns.h"
#include "sublimit/stencils/shards/mesh_part.h"

namespace sublimit {

/// Returns the faces of the refined level on the faces that a part owns.
/// @param lattices  lattices of the part, which has one ring more around it than `shard_rings`
/// @param points    for each face of the part, owned or not: number of its first point in the whole table, and
///                  number of its points
/// @return  faces in the order of the owned faces, without those of holes. Corners are points of the whole
///          table, which must not have more than 32-bit indices count
/// @throws AnalysisError  a face beside an owned one has another number of points in this part than in the
///                        whole
FaceList faces_between(PartLattices lattices, const MeshPart& part,
                       std::span<const std::array<std::int64_t, 2>> points);

}  // namespace sublimit
