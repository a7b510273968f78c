// SPDX-License-Identifier: Apache-2.0
#include "sublimit/bake.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"

namespace sublimit {
namespace {

/// A face has four million points then.
constexpr int last_level = 11;

StencilTable<double> as_table(const SparseMatrix& S) {
  const auto entries = static_cast<size_t>(S.nonZeros());
  return StencilTable<double>(static_cast<std::int32_t>(S.cols()),
                              std::vector<std::int64_t>(S.outerIndexPtr(), S.outerIndexPtr() + S.rows() + 1),
                              std::vector<std::int32_t>(S.innerIndexPtr(), S.innerIndexPtr() + entries),
                              std::vector<double>(S.valuePtr(), S.valuePtr() + entries));
}

}  // namespace

BakedLevel bake_level(Patterns& patterns, const ControlMesh& mesh, int levels, const SubdivisionOptions& options) {
  if (levels < 1 || levels > last_level)
    throw InvalidParameter("level " + std::to_string(levels) + " of a table; 1 to " + std::to_string(last_level) +
                           " are right");
  const Scheme<double>& scheme = patterns.scheme();
  BakedLevel baked;
  PatternTable<double>::Arrays arrays;
  baked.level = control_level(scheme, mesh, options);
  baked.levels = levels;
  const Index sides = scheme.face_size() == 3 ? 3 : 4;
  const Index num_control_points = baked.level.topology().num_vertices();
  if (baked.level.topology().uniform_face_size() != sides) {
    baked.level = next_level(scheme, baked.level);
    arrays.first = as_table(baked.level.S);
    --baked.levels;
    baked.statistics.first_by_rows = true;
  }
  const Topology& t = baked.level.topology();
  const Index num_faces = t.num_faces();
  const Lattice lattice{Index{1} << baked.levels, sides == 3};

  // Types, in parallel.
  std::vector<Patterns::Match> matches(num_faces);
  parallel_for_blocks(
      num_faces,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t f = begin; f < end; ++f)
          matches[f] = patterns.match(baked.level, Face{static_cast<Index>(f)});
      },
      1024);

  // Blocks, in the order in which faces meet them.
  std::unordered_map<const PieceType*, Index> block_of;
  std::vector<const PieceType*> types;
  struct Patch {
    Index block = 0;
    std::uint8_t share = 0;
    Index face = 0;
  };
  std::vector<Patch> patches(num_faces);
  std::vector<std::int8_t> turn(num_faces);
  for (Index f = 0; f < num_faces; ++f) {
    const auto [block, is_new] = block_of.try_emplace(matches[f].type, static_cast<Index>(types.size()));
    if (is_new) types.push_back(matches[f].type);
    patches[f] = {block->second, 0, f};
    turn[f] = static_cast<std::int8_t>(matches[f].turn);
  }
  std::vector<const RowMatrix*> rows(types.size());
  parallel_for_blocks(
      static_cast<std::int64_t>(types.size()),
      [&](std::int64_t i, std::int64_t, std::int64_t) { rows[i] = &patterns.rows(*types[i], baked.levels); }, 1);
  for (const RowMatrix* R : rows) {
    arrays.blocks.push_back({static_cast<std::int32_t>(R->rows()), static_cast<std::int32_t>(R->cols()),
                             static_cast<std::int64_t>(arrays.weights.size())});
    arrays.weights.insert(arrays.weights.end(), R->data(), R->data() + R->size());
  }

  // Groups, and the points that faces have.
  baked.points = LatticePoints(t, lattice, std::move(turn));
  for (Patch& patch : patches) patch.share = baked.points.share(Face{patch.face});
  std::sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) {
    return std::tie(a.block, a.share, a.face) < std::tie(b.block, b.share, b.face);
  });
  size_t num_columns = 0;
  for (const Patterns::Match& match : matches) num_columns += match.vertices.size();
  arrays.columns.reserve(num_columns);
  std::int64_t next = 0;
  for (size_t at = 0; at < patches.size();) {
    const auto [block, share, ignored] = patches[at];
    const std::vector<std::int32_t> own = baked.points.rows(share);
    PatternTable<double>::Group group{block, static_cast<std::int32_t>(own.size()),
                                      static_cast<std::int64_t>(arrays.rows.size()), 0};
    for (; at < patches.size() && patches[at].block == block && patches[at].share == share; ++at) {
      const Index f = patches[at].face;
      baked.points.set_first(Face{f}, next);
      next += group.num_rows;
      if (group.num_rows == 0) continue;  // level 1 of a first step by rows: all corners are others'
      arrays.columns.insert(arrays.columns.end(), matches[f].vertices.begin(), matches[f].vertices.end());
      ++group.num_patches;
    }
    if (group.num_patches == 0) continue;
    arrays.rows.insert(arrays.rows.end(), own.begin(), own.end());
    arrays.groups.push_back(group);
  }
  // Isolated vertices stay where they are.
  PatternTable<double>::Group alone{static_cast<std::int32_t>(arrays.blocks.size()), 1,
                                    static_cast<std::int64_t>(arrays.rows.size()), 0};
  for (Index v = 0; v < t.num_vertices(); ++v)
    if (t.is_isolated(Vertex{v})) {
      arrays.columns.push_back(v);
      ++alone.num_patches;
    }
  if (alone.num_patches > 0) {
    arrays.blocks.push_back({1, 1, static_cast<std::int64_t>(arrays.weights.size())});
    arrays.weights.push_back(1);
    arrays.rows.push_back(0);
    arrays.groups.push_back(alone);
  }

  BakeStatistics& s = baked.statistics;
  s.faces = num_faces;
  s.types = static_cast<Index>(types.size());
  s.blocks = static_cast<Index>(arrays.blocks.size());
  s.groups = static_cast<Index>(arrays.groups.size());
  baked.table = PatternTable<double>(num_control_points, std::move(arrays));
  s.points = baked.table.num_points();
  s.bytes = baked.table.num_bytes();
  return baked;
}

}  // namespace sublimit
