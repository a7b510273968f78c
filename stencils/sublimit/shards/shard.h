// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table in parts: each makes the points of some faces, from the control points around them. Every point of a level or
// its limit is of one part: of the first face, in the order of the mesh, that has it, and of the part that owns that
// face; points stand in the order of these faces, those of no face first. Weights are those of a table of the
// whole, bit by bit, however faces are divided.
#include <cstdint>
#include <vector>

#include "sublimit/bake/bake.h"
#include "sublimit/bake/bake_patterns.h"
#include "sublimit/shards/mesh_part.h"

namespace sublimit {

struct Shard {
  BakedTable<double> table;  ///< over the part's points
  BakeStatistics statistics;
  std::vector<std::int64_t> inputs;  ///< control points of the whole, for each of the table's
  std::vector<PatchPlace> patches;   ///< where points lie, patch after patch: faces of the level that has the patterns
};

/// How many rings a part needs so that all types of owned faces, and the owners of their points, are those of the
/// whole.
/// @param control  of the whole, or of a part
int shard_rings(Patterns& patterns, const Level& control);

/// Of levels and their limits, by patterns.
/// @param part     with `shard_rings` around it at least
/// @param options  of the whole
/// @throws InvalidParameter     another request, or one that patterns cannot make; dual schemes, and those that turn
/// @throws InvalidMesh, UnsupportedTopology, ResourceError  as `bake`
Shard bake_shard(Patterns& patterns, const MeshPart& part, const BakeRequest& request,
                 const SubdivisionOptions& options = {});

}  // namespace sublimit
