// SPDX-License-Identifier: Apache-2.0
#include "sublimit/bake.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/face_owners.h"
#include "sublimit/limit/address.h"

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

/// Places of faces in addresses: those of level 0, or those of level 1, which are quarters of quadrilaterals, and of
/// other polygons all of the square at a corner.
struct Places {
  std::vector<std::int32_t> addresses;
  std::vector<std::uint8_t> places;
  Places(Index count) : addresses(count), places(count) {}
  void set(Face face, Index address, int turn, int quarter) {
    addresses[index(face)] = address;
    places[index(face)] = static_cast<std::uint8_t>(turn + 8 * (quarter + 1));
  }
};

Places places_of_faces(std::span<const std::int8_t> turn) {
  Places places(static_cast<Index>(turn.size()));
  for (size_t f = 0; f < turn.size(); ++f) places.set(Face{static_cast<Index>(f)}, static_cast<Index>(f), turn[f], -1);
  return places;
}

/// @param turn  of the faces of level 1
Places places_of_children(const Level& control, const Level& level, std::span<const std::int8_t> turn) {
  const Topology& t = control.topology();
  const Addresses addresses(t, false);
  const LevelStep step{&level.steps[0], 0};
  Places places(level.topology().num_faces());
  const auto corner = [](int k) { return quad_place(k == 1 || k == 2, k >= 2); };
  parallel_for(addresses.size(), [&](std::int64_t a) {
    const auto address = static_cast<Index>(a);
    const Addresses::Place at = addresses.place(address);
    const bool whole = at.corner >= 0;  // the square at a corner of a polygon, and not a quadrilateral
    const Piece piece =
        whole ? Piece{Piece::Kind::cut, t.corner(at.face, at.corner)} : Piece{Piece::Kind::quad, t.first(at.face)};
    for (const PieceChild& child : children(piece, t, std::span(&step, 1))) {
      // Its quarter, and which of the quarter's corners it begins with.
      int quarter = -1, first = -1;
      for (int k = 0; k < 4; ++k) {
        const Place middle = quad_place(k == 1 || k == 2 ? 0.75 : 0.25, k >= 2 ? 0.75 : 0.25);
        if (!whole && child.map.contains(middle)) quarter = k;
      }
      for (int k = 0; k < 4; ++k) {
        const Place c = corner(k);
        const double half = quarter < 0 ? 1 : 0.5, x = quarter == 1 || quarter == 2 ? 0.5 : 0,
                     y = quarter >= 2 ? 0.5 : 0;
        const Place in_child = child.map(quad_place(x + half * c.u, y + half * c.v));
        if (in_child.u == 0 && in_child.v == 0) first = k;
      }
      const Topology& fine = level.topology();
      const Face face = fine.face(child.piece.start);
      places.set(face, address, (first + turn[index(face)] - fine.corner_index(child.piece.start) + 8) % 4, quarter);
    }
  });
  return places;
}

}  // namespace

Baked bake_level(Patterns& patterns, const ControlMesh& mesh, int levels, const SubdivisionOptions& options) {
  if (levels < 1 || levels > last_level)
    throw InvalidParameter("level " + std::to_string(levels) + " of a table; 1 to " + std::to_string(last_level) +
                           " are right");
  const Scheme<double>& scheme = patterns.scheme();
  Baked baked;
  PatternTable<double>::Arrays arrays;
  const Level control = control_level(scheme, mesh, options);
  std::optional<Level> refined;
  const Index sides = scheme.face_size() == 3 ? 3 : 4;
  const Index num_control_points = control.topology().num_vertices();
  if (control.topology().uniform_face_size() != sides) {
    refined = next_level(scheme, control);
    arrays.first = as_table(refined->S);
    --levels;
    baked.statistics.first_by_rows = true;
  }
  const Level& level = refined ? *refined : control;
  const Topology& t = level.topology();
  const Index num_faces = t.num_faces();
  const Lattice lattice{Index{1} << levels, sides == 3};

  // Types, in parallel.
  std::vector<Patterns::Match> matches(num_faces);
  parallel_for_blocks(
      num_faces,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t f = begin; f < end; ++f) matches[f] = patterns.match(level, Face{static_cast<Index>(f)});
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
      [&](std::int64_t i, std::int64_t, std::int64_t) { rows[i] = &patterns.rows(*types[i], levels); }, 1);
  std::vector<double> weights;
  for (const RowMatrix* R : rows) {
    arrays.blocks.push_back({static_cast<std::int32_t>(R->rows()), static_cast<std::int32_t>(R->cols()),
                             static_cast<std::int64_t>(weights.size())});
    weights.insert(weights.end(), R->data(), R->data() + R->size());
  }

  // Groups, and the points that faces have.
  FaceLattices::Arrays lattices = face_owners(t, lattice, turn);
  parallel_for(num_faces,
               [&](std::int64_t f) { patches[f].share = FaceLattices::share(lattices, static_cast<Index>(f)); });
  std::sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) {
    return std::tie(a.block, a.share, a.face) < std::tie(b.block, b.share, b.face);
  });
  size_t num_columns = 0;
  for (const Patterns::Match& match : matches) num_columns += match.vertices.size();
  std::vector<std::int32_t> columns, chosen;
  columns.reserve(num_columns);
  std::vector<std::int64_t> first_points(num_faces);
  std::int64_t next = 0;
  for (size_t at = 0; at < patches.size();) {
    const auto [block, share, ignored] = patches[at];
    const std::vector<std::int32_t> own = FaceLattices::rows(lattice, share);
    PatternTable<double>::Group group{block, static_cast<std::int32_t>(own.size()),
                                      static_cast<std::int64_t>(chosen.size()), 0};
    for (; at < patches.size() && patches[at].block == block && patches[at].share == share; ++at) {
      const Index f = patches[at].face;
      first_points[f] = next;
      next += group.num_rows;
      if (group.num_rows == 0) continue;  // level 1 of a first step by rows: all corners are others'
      columns.insert(columns.end(), matches[f].vertices.begin(), matches[f].vertices.end());
      ++group.num_patches;
    }
    if (group.num_patches == 0) continue;
    chosen.insert(chosen.end(), own.begin(), own.end());
    arrays.groups.push_back(group);
  }
  // Isolated vertices stay where they are.
  PatternTable<double>::Group alone{static_cast<std::int32_t>(arrays.blocks.size()), 1,
                                    static_cast<std::int64_t>(chosen.size()), 0};
  for (Index v = 0; v < t.num_vertices(); ++v)
    if (t.is_isolated(Vertex{v})) {
      columns.push_back(v);
      ++alone.num_patches;
    }
  if (alone.num_patches > 0) {
    arrays.blocks.push_back({1, 1, static_cast<std::int64_t>(weights.size())});
    weights.push_back(1);
    chosen.push_back(0);
    arrays.groups.push_back(alone);
  }
  arrays.weights = std::move(weights);
  arrays.rows = std::move(chosen);
  arrays.columns = std::move(columns);

  BakeStatistics& s = baked.statistics;
  s.faces = num_faces;
  s.types = static_cast<Index>(types.size());
  s.blocks = static_cast<Index>(arrays.blocks.size());
  s.groups = static_cast<Index>(arrays.groups.size());
  baked.table.table = PatternTable<double>(num_control_points, std::move(arrays));
  s.points = baked.table.table.num_points();
  s.bytes = baked.table.table.num_bytes();
  if (scheme.preparation.empty() || !refined) {
    Places places = refined ? places_of_children(control, *refined, turn) : places_of_faces(turn);
    lattices.addresses = std::move(places.addresses);
    lattices.places = std::move(places.places);
  }
  lattices.first_points = std::move(first_points);
  if (std::find(level.holes.begin(), level.holes.end(), true) != level.holes.end())
    lattices.holes = std::vector<std::uint8_t>(level.holes.begin(), level.holes.end());
  baked.table.lattices.emplace(s.points, std::move(lattices));
  return baked;
}

}  // namespace sublimit
