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

/// Points of a shard that follow each other in the whole too.
struct PointRun {
  std::int64_t first = 0;  ///< of the whole
  std::int64_t count = 0;
};

struct Shard {
  BakedTable<double> table;  ///< over the part's points
  BakeStatistics statistics;
  std::vector<std::int64_t> inputs;  ///< control points of the whole, for each of the table's
  std::vector<PatchPlace> patches;   ///< where points lie, patch after patch: faces of the level that has the patterns
  std::vector<PointRun> runs;        ///< where its points stand, in their order; left to who knows the whole
};

/// How many rings a part needs so that all types of owned faces, and the owners of their points, are those of the
/// whole.
int shard_rings(Patterns& patterns, Creasing creasing);

/// How parts of a mesh are to be baked, all alike.
/// @param all_whole  whether every face of the whole mesh has as many corners as the scheme splits without a first step
/// @throws InvalidParameter  a request that is not of levels or their limits, or that patterns cannot make; dual
///                           schemes, and those that turn
BakeMethod shard_method(Patterns& patterns, const BakeRequest& request, bool all_whole);

/// What a face has of the points on its sides.
struct FaceShare {
  std::int64_t corners = 0;      ///< of the face
  std::int64_t own_sides = 0;    ///< that no face before it has
  std::int64_t own_corners = 0;  ///< likewise
};
/// How many points a face has of what is asked for: known before any table is made.
std::int64_t num_points(const Scheme<double>& scheme, const BakeRequest& request, BakeMethod method,
                        const FaceShare& face);

/// Of levels and their limits, by patterns.
/// @param part     with `shard_rings` around it at least
/// @param method   `shard_method` of the whole
/// @param options  of the whole
/// @param lattices  gets how points lie on faces, if given: right on owned faces and, with one ring more than
///                  `shard_rings`, on those beside them
/// @throws InvalidMesh, UnsupportedTopology, ResourceError  as `bake`; InvalidParameter
Shard bake_shard(Patterns& patterns, const MeshPart& part, const BakeRequest& request, BakeMethod method,
                 const SubdivisionOptions& options = {}, PartLattices* lattices = nullptr);

}  // namespace sublimit
