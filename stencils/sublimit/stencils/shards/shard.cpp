// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/shards/shard.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/stencils/bake/detail/table_info.h"

namespace sublimit {
namespace {

/// Vertices of no face stay where they are.
BakedTable<double> isolated_vertices(Index count) {
  PatternTable<double>::Arrays arrays;
  if (count > 0) {
    arrays.blocks = {{1, 1, 0}};
    arrays.weights = std::vector<double>{1};
    arrays.groups = {{0, 1, 0, count}};
    arrays.rows = std::vector<std::int32_t>{0};
    std::vector<std::int32_t> columns(static_cast<size_t>(count));
    std::iota(columns.begin(), columns.end(), 0);
    arrays.columns = std::move(columns);
  }
  BakedTable<double> baked;
  baked.table = PatternTable<double>(count, std::move(arrays));
  return baked;
}

/// The same table with points in the order of faces, those of no face first: however faces are divided, in runs, points
/// of all shards one after the other stand in the same order.
PatternTable<double> in_order_of_faces(const PatternTable<double>& table, const std::vector<PatchPlace>& patches) {
  PatternTable<double>::Arrays arrays = table.arrays();
  struct Patch {
    Index control_face = -1, face = -1;
    std::int64_t number = 0;
    std::int32_t points = 0;
  };
  std::vector<Patch> order;
  for (const auto& group : arrays.groups)
    for (std::int64_t i = 0; i < group.num_patches; ++i) order.push_back({-1, -1, std::ssize(order), group.num_rows});
  for (size_t p = 0; p < patches.size(); ++p)
    order[p].control_face = patches[p].control_face, order[p].face = patches[p].face;
  std::ranges::stable_sort(order, {}, [](const Patch& p) { return std::pair(p.control_face, p.face); });
  std::vector<std::int64_t> first(order.size());
  std::int64_t next = 0;
  for (const Patch& patch : order) {
    first[size_t(patch.number)] = next;
    next += patch.points;
  }
  arrays.patch_points = std::move(first);
  return PatternTable<double>(table.num_control_points(), std::move(arrays));
}

}  // namespace

int shard_rings(Patterns& patterns, Creasing creasing) {
  Sharpness sharpness;
  sharpness.creasing = creasing;
  // Tags of the outermost faces depend on what is beside them. Where level 1 has the patterns its faces reach no
  // farther than half as far, but rows of level 1 take a ring.
  return patterns.types()->pieces().rings(sharpness) + 2;
}

BakeMethod shard_method(Patterns& patterns, const BakeRequest& request, bool all_whole) {
  check(request);
  if (request.rows != TableRows::level && request.rows != TableRows::limit)
    throw InvalidParameter("shards are of levels and their limits");
  if (needs_refined_mesh(request) || request.derivatives > 0)
    throw InvalidParameter("shards have positions alone: no derivatives, face-varying values or tags");
  // Points of dual schemes are those of corners, and rows of schemes that turn reach farther: neither is divided yet.
  if (patterns.scheme().is_dual() || patterns.scheme().period > 1)
    throw InvalidParameter(patterns.scheme().name +
                           ": no shards of dual schemes, nor of those that turn; `sublimit bake` makes one table");
  if (all_whole) return BakeMethod::patterns;
  if (request.level == 0)
    throw InvalidParameter(patterns.scheme().name +
                           ": faces of other sizes are cut by the first level; ask for the limit of level 1 or more");
  return BakeMethod::rows_then_patterns;
}

std::int64_t num_points(const Scheme<double>& scheme, const BakeRequest& request, BakeMethod method,
                        const FaceShare& face) {
  const bool by_rows = method == BakeMethod::rows_then_patterns;
  const Lattice lattice = Patterns::lattice_of(scheme, request.level - by_rows);
  std::int64_t inner = std::ssize(LatticeRanks::rows(lattice, 0)), side = lattice.n - 1;
  if (by_rows) {  // a child at each corner, their common sides, and the point in the middle
    inner = face.corners * (inner + side) + 1;
    side = 2 * side + 1;
  }
  return inner + face.own_sides * side + face.own_corners;
}

Shard bake_shard(Patterns& patterns, const MeshPart& part, const BakeRequest& request, BakeMethod method,
                 const SubdivisionOptions& options, PartLattices* lattices) {
  if (part.mesh.num_faces() == 0) return {isolated_vertices(part.mesh.num_vertices()), {}, part.vertices, {}, {}};
  const Level control = control_level(patterns.scheme(), part.mesh, options);
  Shard shard;
  shard.inputs = part.vertices;
  std::optional<Baked> baked = bake_by_patterns(patterns, control, request,
                                                {.first_by_rows = method == BakeMethod::rows_then_patterns,
                                                 .owners = OwnerRule::first,
                                                 .owned = &part.is_owned,
                                                 .patches = &shard.patches,
                                                 .lattices = lattices});
  if (!baked) throw InvalidParameter(patterns.scheme().name + ": such a table cannot be made by patterns alone");
  shard.table = std::move(baked->table);
  shard.table.table = in_order_of_faces(shard.table.table, shard.patches);
  shard.table.info = table_info(patterns.scheme(), part.mesh, request, options);
  shard.statistics = baked->statistics;
  return shard;
}

}  // namespace sublimit
