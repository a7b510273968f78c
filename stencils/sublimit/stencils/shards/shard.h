// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table in shards: each makes the points of some faces, from the control points around them. Every point of a level
// or its limit belongs to the first face of the mesh that has it, and to the shard that owns this face. Points are
// ordered by these faces, points of no face first. Weights have the bits of a table of the whole mesh, for any division
// of the faces.
#include <cstdint>
#include <vector>

#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/bake/detail/bake_patterns.h"
#include "sublimit/stencils/shards/mesh_part.h"

namespace sublimit {

/// Consecutive points of a shard that are consecutive in the whole table too.
struct PointRun {
  std::int64_t first = 0;  ///< number of the first point in the whole table
  std::int64_t count = 0;  ///< number of points
};

/// A shard of a table.
struct Shard {
  BakedTable<double> table;  ///< table over the part's control points
  BakeStatistics statistics;
  std::vector<std::int64_t> inputs;  ///< control point of the whole mesh, for each of the table
  std::vector<PatchPlace> patches;   ///< places of the points, patch by patch, on faces of the level with patterns
  std::vector<PointRun> runs;        ///< positions of its points in the whole table; set by the caller
};

/// Returns the number of rings around a part that make the types of its faces, and the owners of their points, those of
/// the whole mesh.
int shard_rings(Patterns& patterns, Creasing creasing);

/// Returns the method for all parts of a mesh.
/// @param all_whole  true if the scheme splits every face of the whole mesh without a first step
/// @throws InvalidParameter  a request that is not for levels or their limits, or that patterns cannot make; dual
///                           schemes, and those that rotate the grid
BakeMethod shard_method(Patterns& patterns, const BakeRequest& request, bool all_whole);

/// Sides and corners of a face, and those that it owns.
struct FaceShare {
  std::int64_t corners = 0;      ///< number of corners
  std::int64_t own_sides = 0;    ///< number of sides that no previous face has
  std::int64_t own_corners = 0;  ///< number of corners that no previous face has
};
/// Returns the number of points of a request that a face owns, without making a table.
std::int64_t num_points(const Scheme<double>& scheme, const BakeRequest& request, BakeMethod method,
                        const FaceShare& face);

/// Bakes a shard of a level or its limits, by patterns.
/// @param part      part of the mesh, with at least `shard_rings` rings around it
/// @param method    `shard_method` of the whole mesh
/// @param options   options of the whole mesh
/// @param lattices  if given, set to the lattices of points: correct on owned faces and, with one ring more than
///                  `shard_rings`, on those beside them
/// @throws InvalidMesh, UnsupportedTopology, ResourceError  as `bake`; InvalidParameter
Shard bake_shard(Patterns& patterns, const MeshPart& part, const BakeRequest& request, BakeMethod method,
                 const SubdivisionOptions& options = {}, PartLattices* lattices = nullptr);

}  // namespace sublimit
