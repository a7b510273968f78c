// SPDX-License-Identifier: Apache-2.0
#include "sublimit/bake.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"

namespace sublimit {
namespace {

StencilTable<double> as_table(const SparseMatrix& S) {
  const auto entries = static_cast<size_t>(S.nonZeros());
  return StencilTable<double>(static_cast<std::int32_t>(S.cols()),
                              std::vector<std::int64_t>(S.outerIndexPtr(), S.outerIndexPtr() + S.rows() + 1),
                              std::vector<std::int32_t>(S.innerIndexPtr(), S.innerIndexPtr() + entries),
                              std::vector<double>(S.valuePtr(), S.valuePtr() + entries));
}

/// The half-edge of each edge and vertex whose face has its points: the first one.
class Owners {
 public:
  explicit Owners(const Topology& t) : t_(t), of_vertex_(t.num_vertices(), -1) {
    for (Index h = t.num_half_edges(); h-- > 0;) of_vertex_[index(t.tail(HalfEdge{h}))] = h;
  }
  HalfEdge of(Edge e) const { return t_.half_edge(e); }
  HalfEdge of(Vertex v) const { return HalfEdge{of_vertex_[index(v)]}; }
  /// Whether a half-edge runs as the one that has its edge does.
  bool runs_along(HalfEdge h) const {
    const HalfEdge first = of(t_.edge(h));
    return h == first || (t_.twin(h) != first && t_.tail(h) == t_.tail(first));
  }

 private:
  const Topology& t_;
  std::vector<Index> of_vertex_;
};

}  // namespace

BakedLevel bake_level(Patterns& patterns, const ControlMesh& mesh, int levels, const SubdivisionOptions& options) {
  if (levels < 1) throw InvalidParameter("level " + std::to_string(levels) + " of a table; 1 or more is right");
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
  baked.lattice = {Index{1} << baked.levels, sides == 3};
  const Lattice& lattice = baked.lattice;

  // Types, in parallel.
  std::vector<Patterns::Match> matches(num_faces);
  parallel_for_blocks(
      num_faces,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t f = begin; f < end; ++f)
          matches[f] = patterns.match(baked.level, Face{static_cast<Index>(f)});
      },
      1024);

  // Which sides and corners of its type a face has: bits k and 4 + k.
  const Owners owners(t);
  struct Patch {
    Index block, have, face;
  };
  std::unordered_map<const PieceType*, Index> block_of;
  std::vector<const PieceType*> types;
  std::vector<Patch> patches(num_faces);
  baked.turn.resize(num_faces);
  for (Index f = 0; f < num_faces; ++f) {
    const auto [block, is_new] = block_of.try_emplace(matches[f].type, static_cast<Index>(types.size()));
    if (is_new) types.push_back(matches[f].type);
    baked.turn[f] = static_cast<std::int8_t>(matches[f].turn);
    Index have = 0;
    for (int k = 0; k < sides; ++k) {
      const HalfEdge h = t.corner(Face{f}, (matches[f].turn + k) % sides);
      if (owners.of(t.edge(h)) == h) have |= Index{1} << k;
      if (owners.of(t.tail(h)) == h) have |= Index{16} << k;
    }
    patches[f] = {block->second, have, f};
  }
  std::sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) {
    return std::tie(a.block, a.have, a.face) < std::tie(b.block, b.have, b.face);
  });

  // Blocks.
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
  baked.points.assign(std::int64_t(num_faces) * lattice.size(), -1);
  std::int64_t next = 0;
  for (size_t at = 0; at < patches.size();) {
    const auto [block, have, ignored] = patches[at];
    PatternTable<double>::Group group{block, 0, static_cast<std::int64_t>(arrays.rows.size()), 0};
    lattice.for_each_inner([&](Index row) { arrays.rows.push_back(row); });
    for (int k = 0; k < sides; ++k)
      for (Index s = 1; s < lattice.n && (have >> k & 1); ++s) arrays.rows.push_back(lattice.on_side(k, s));
    for (int k = 0; k < sides; ++k)
      if (have >> (4 + k) & 1) arrays.rows.push_back(lattice.on_side(k, 0));
    group.num_rows = static_cast<std::int32_t>(static_cast<std::int64_t>(arrays.rows.size()) - group.rows);
    for (; at < patches.size() && patches[at].block == block && patches[at].have == have; ++at, ++group.num_patches) {
      const Index f = patches[at].face;
      arrays.columns.insert(arrays.columns.end(), matches[f].vertices.begin(), matches[f].vertices.end());
      std::int64_t* own = baked.points.data() + std::int64_t(f) * lattice.size();
      for (std::int32_t i = 0; i < group.num_rows; ++i) own[arrays.rows[group.rows + i]] = next++;
    }
    arrays.groups.push_back(group);
  }
  // Sides and corners that other faces have.
  parallel_for(num_faces, [&](std::int64_t f) {
    const Face face{static_cast<Index>(f)};
    std::int64_t* own = baked.points.data() + f * lattice.size();
    const auto side_of = [&](HalfEdge h) { return (t.corner_index(h) - baked.turn[index(t.face(h))] + sides) % sides; };
    for (int k = 0; k < sides; ++k) {
      const HalfEdge h = t.corner(face, (baked.turn[f] + k) % sides);
      if (const HalfEdge first = owners.of(t.edge(h)); first != h)
        for (Index s = 1; s < lattice.n; ++s)
          own[lattice.on_side(k, s)] =
              baked.point(t.face(first), lattice.on_side(side_of(first), owners.runs_along(h) ? s : lattice.n - s));
      if (const HalfEdge first = owners.of(t.tail(h)); first != h)
        own[lattice.on_side(k, 0)] = baked.point(t.face(first), lattice.on_side(side_of(first), 0));
    }
  });
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
