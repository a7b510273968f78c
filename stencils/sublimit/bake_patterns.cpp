// SPDX-License-Identifier: Apache-2.0
#include "sublimit/bake_patterns.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <unordered_map>

#include "sublimit/analysis/limit_status.h"
#include "sublimit/bake_rows.h"
#include "sublimit/base/memory.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/face_owners.h"
#include "sublimit/face_places.h"
#include "sublimit/limit/limit_surface.h"

namespace sublimit {
namespace {

using Arrays = PatternTable<double>::Arrays;

/// Pieces of a level, their types, and where their lattices lie.
struct Pieces {
  std::vector<Patterns::Match> matches;
  std::vector<LatticePlace> places;  ///< or none
  Index count() const { return static_cast<Index>(matches.size()); }
  std::vector<std::int8_t> turns() const {
    std::vector<std::int8_t> turns;
    for (const Patterns::Match& match : matches) turns.push_back(static_cast<std::int8_t>(match.turn));
    return turns;
  }
};

/// Those that are known in parallel, then each new type by the first piece that has it.
template <class PieceAt>
std::vector<Patterns::Match> matches_of(Patterns& patterns, const Level& level, Index count, const PieceAt& piece_at) {
  std::vector<Patterns::Match> matches(count);
  constexpr std::int64_t per_block = 1024;
  std::vector<std::vector<Index>> unknown(num_blocks(count, per_block));
  const auto find = [&](Index i, std::vector<Index>& missing) {
    matches[i] = patterns.find(level, piece_at(i));
    if (!matches[i].type) missing.push_back(i);
  };
  parallel_for_blocks(
      count,
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) find(static_cast<Index>(i), unknown[block]);
      },
      per_block);
  std::vector<Index> rest;
  for (const std::vector<Index>& part : unknown) rest.insert(rest.end(), part.begin(), part.end());
  // A new type settles many of the others.
  while (!rest.empty()) {
    const size_t some = std::min<size_t>(rest.size(), 64);
    for (size_t i = 0; i < some; ++i) matches[rest[i]] = patterns.match(level, piece_at(rest[i]));
    std::vector<std::vector<Index>> left(num_blocks(std::int64_t(rest.size() - some), per_block));
    parallel_for_blocks(
        std::int64_t(rest.size() - some),
        [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
          for (std::int64_t i = begin; i < end; ++i) find(rest[some + size_t(i)], left[block]);
        },
        per_block);
    rest.clear();
    for (const std::vector<Index>& part : left) rest.insert(rest.end(), part.begin(), part.end());
  }
  return matches;
}

/// Blocks of a table, in the order in which pieces meet them, made in parallel.
class Blocks {
 public:
  struct Key {
    const PieceType* type = nullptr;
    LatticePlace place;  ///< where it matters: its turn and quarter
    bool operator==(const Key& other) const {
      return type == other.type && place.turn == other.place.turn && place.quarter == other.place.quarter;
    }
  };
  Index add(const Key& key) {
    if (!keys_.empty() && keys_[last_] == key) return last_;  // on large meshes most are like the one before
    const auto [at, is_new] = numbers_.try_emplace(key, static_cast<Index>(keys_.size()));
    if (is_new) keys_.push_back(key);
    return last_ = at->second;
  }
  Index num_types() const {
    std::vector<const PieceType*> types;
    for (const Key& key : keys_) types.push_back(key.type);
    std::sort(types.begin(), types.end());
    return static_cast<Index>(std::unique(types.begin(), types.end()) - types.begin());
  }
  const std::vector<Key>& keys() const { return keys_; }

  /// @param rows       points of a block
  /// @param make       weights of a key, or null: those of types whose sums have an order are asked for in turn
  /// @return  false if one is null
  template <class Make>
  bool fill(Arrays& arrays, std::int32_t rows, const Make& make) const {
    std::vector<const RowMatrix*> made(keys_.size());
    for (size_t i = 0; i < keys_.size(); ++i)
      if (keys_[i].type->decays()) made[i] = make(keys_[i]);
    parallel_for_blocks(
        static_cast<std::int64_t>(keys_.size()),
        [&](std::int64_t i, std::int64_t, std::int64_t) {
          if (!made[i]) made[i] = make(keys_[i]);
        },
        1);
    if (std::find(made.begin(), made.end(), nullptr) != made.end()) return false;
    std::vector<double> weights;
    for (const RowMatrix* W : made) {
      arrays.blocks.push_back({rows, static_cast<std::int32_t>(W->cols()), static_cast<std::int64_t>(weights.size())});
      weights.insert(weights.end(), W->data(), W->data() + W->size());
    }
    arrays.weights = std::move(weights);
    return true;
  }
  double num_bytes(double rows) const {
    double bytes = 0;
    for (const Key& key : keys_) bytes += rows * key.type->num_slots() * sizeof(double);
    return bytes;
  }

 private:
  struct Hash {
    size_t operator()(const Key& key) const {
      return std::hash<const PieceType*>()(key.type) + 31 * size_t(8 * (key.place.quarter + 1) + key.place.turn);
    }
  };
  std::unordered_map<Key, Index, Hash> numbers_;
  std::vector<Key> keys_;
  Index last_ = 0;
};

struct Patch {
  Index block = 0;
  std::uint8_t share = 0;  // of a lattice; of grids: 1 for a hole
  Index piece = 0;
};

/// Groups, and the control points of their patches.
class Groups {
 public:
  void begin(Index block, std::span<const std::int32_t> own) {
    group_ = {block, static_cast<std::int32_t>(own.size()), static_cast<std::int64_t>(rows.size()), 0};
    rows.insert(rows.end(), own.begin(), own.end());
  }
  void add(std::span<const Index> vertices) {
    columns.insert(columns.end(), vertices.begin(), vertices.end());
    ++group_.num_patches;
  }
  void end() {
    if (group_.num_patches > 0)
      groups.push_back(group_);
    else
      rows.resize(size_t(group_.rows));
  }
  std::vector<PatternTable<double>::Group> groups;
  std::vector<std::int32_t> rows, columns;

 private:
  PatternTable<double>::Group group_;
};

bool by_block(const Patch& a, const Patch& b) {
  return std::tie(a.block, a.share, a.piece) < std::tie(b.block, b.share, b.piece);
}

/// Vertices of level k, or their limits: points are shared between faces.
std::optional<Baked> bake_lattices(Patterns& patterns, const Level& control, const BakeRequest& request,
                                   bool first_by_rows, double most_bytes) {
  const Scheme<double>& scheme = patterns.scheme();
  if (!Patterns::is_possible(scheme)) return std::nullopt;
  const Index sides = scheme.face_size() == 3 ? 3 : 4;
  const int levels = request.level - (first_by_rows ? 1 : 0);
  if (levels < 0 || (!first_by_rows && control.topology().uniform_face_size() != sides)) return std::nullopt;
  const bool limit = request.rows == TableRows::limit;

  Baked baked;
  Arrays arrays;
  arrays.quantities = request.derivatives == 0 ? 1 : request.derivatives == 1 ? 3 : 6;
  std::optional<Level> refined;
  if (first_by_rows) {
    refined = next_level(scheme, control);
    arrays.first = as_table(refined->S);
  }
  const Level& level = refined ? *refined : control;
  const Topology& t = level.topology();
  const Lattice lattice{Index{1} << levels, sides == 3};
  const auto kind = sides == 3 ? Piece::Kind::triangle : Piece::Kind::quad;

  Pieces pieces;
  pieces.matches = matches_of(patterns, level, t.num_faces(), [&](Index f) { return Piece{kind, t.first(Face{f})}; });
  const std::vector<std::int8_t> turn = pieces.turns();
  if (!first_by_rows)
    pieces.places = places_of_faces(turn);
  else if (auto places = places_of_children(scheme, control, level, turn))
    pieces.places = std::move(*places);
  if (request.derivatives > 0 && pieces.places.empty() && t.num_faces() > 0) return std::nullopt;

  Blocks blocks;
  FaceLattices::Arrays lattices = face_owners(t, lattice, turn);
  std::vector<Patch> patches(t.num_faces());
  for (Index f = 0; f < t.num_faces(); ++f)
    patches[f] = {blocks.add({pieces.matches[f].type, request.derivatives > 0 ? pieces.places[f] : LatticePlace{}}), 0,
                  f};
  const double bytes = blocks.num_bytes(double(arrays.quantities) * lattice.size());
  if (bytes > most_bytes) return std::nullopt;
  check_memory(std::to_string(blocks.keys().size()) + " blocks of level " + std::to_string(request.level), 4 * bytes,
               "use fewer levels");
  std::vector<const std::vector<std::uint8_t>*> status(blocks.keys().size(), nullptr);
  const bool made = blocks.fill(arrays, lattice.size(), [&](const Blocks::Key& key) -> const RowMatrix* {
    if (!limit) return &patterns.rows(*key.type, levels);
    if (request.derivatives == 0) return &patterns.limit_rows(*key.type, levels);
    const Patterns::LimitBlock* block = patterns.limit_block(*key.type, lattice, key.place, false, request.derivatives);
    return block ? &block->weights : nullptr;
  });
  if (!made) return std::nullopt;
  const bool has_status = limit && request.derivatives > 0;
  if (has_status)
    for (size_t b = 0; b < status.size(); ++b)
      status[b] =
          &patterns.limit_block(*blocks.keys()[b].type, lattice, blocks.keys()[b].place, false, request.derivatives)
               ->status;

  // Groups, and the points that faces have.
  parallel_for(t.num_faces(),
               [&](std::int64_t f) { patches[f].share = FaceLattices::share(lattices, static_cast<Index>(f)); });
  std::sort(patches.begin(), patches.end(), by_block);
  Groups groups;
  std::vector<std::uint8_t> row_status;
  std::vector<std::int64_t> first_points(t.num_faces());
  std::int64_t next = 0;
  for (size_t at = 0; at < patches.size();) {
    const auto [block, share, ignored] = patches[at];
    const std::vector<std::int32_t> own = FaceLattices::rows(lattice, share);
    groups.begin(block, own);
    for (; at < patches.size() && patches[at].block == block && patches[at].share == share; ++at) {
      const Index f = patches[at].piece;
      first_points[f] = next;
      next += std::int64_t(own.size());
      if (!own.empty()) groups.add(pieces.matches[f].vertices);  // level 1 of a first step: all corners may be others'
    }
    groups.end();
    if (has_status)
      for (size_t i = row_status.size(); i < groups.rows.size(); ++i)
        row_status.push_back((*status[block])[groups.rows[i]]);
  }
  // Isolated vertices stay where they are.
  Index alone = -1;
  for (Index v = 0; v < t.num_vertices(); ++v)
    if (t.is_isolated(Vertex{v})) {
      if (alone < 0) {
        alone = static_cast<Index>(arrays.blocks.size());
        std::vector<double> weights(arrays.weights.begin(), arrays.weights.end());
        arrays.blocks.push_back({1, 1, static_cast<std::int64_t>(weights.size())});
        weights.push_back(1);
        weights.resize(weights.size() + size_t(arrays.quantities) - 1, 0.0);
        arrays.weights = std::move(weights);
        const std::int32_t only = 0;
        groups.begin(alone, {&only, 1});
      }
      groups.add({&v, 1});
    }
  if (alone >= 0) {
    groups.end();
    if (has_status) row_status.push_back(std::uint8_t(LimitStatus::undefined_normal));
  }
  arrays.groups = std::move(groups.groups);
  arrays.rows = std::move(groups.rows);
  arrays.columns = std::move(groups.columns);
  baked.table.row_status = std::move(row_status);
  baked.table.table = PatternTable<double>(control.topology().num_vertices(), std::move(arrays));

  if (!pieces.places.empty()) {
    std::vector<std::int32_t> addresses;
    std::vector<std::uint8_t> places;
    for (const LatticePlace& place : pieces.places) {
      addresses.push_back(place.address);
      places.push_back(static_cast<std::uint8_t>(place.turn + 8 * (place.quarter + 1)));
    }
    lattices.addresses = std::move(addresses);
    lattices.places = std::move(places);
  }
  lattices.first_points = std::move(first_points);
  if (std::find(level.holes.begin(), level.holes.end(), true) != level.holes.end())
    lattices.holes = std::vector<std::uint8_t>(level.holes.begin(), level.holes.end());
  baked.table.lattices.emplace(baked.table.table.num_points(), std::move(lattices));
  baked.statistics.faces = t.num_faces();
  baked.statistics.types = blocks.num_types();
  return baked;
}

/// The same places on every address: each has all of its points, and positions on sides are copied.
std::optional<Baked> bake_grids(Patterns& patterns, const Level& control, const BakeRequest& request,
                                double most_bytes) {
  const Scheme<double>& scheme = patterns.scheme();
  const Topology& t = control.topology();
  if (scheme.is_dual() || (!scheme.preparation.empty() && t.uniform_face_size() != scheme.corners)) return std::nullopt;
  const Addresses addresses(t, scheme.face_size() == 3);
  const Lattice lattice{request.grid - 1, addresses.triangles()};
  Baked baked;
  Arrays arrays;
  arrays.quantities = request.derivatives == 0 ? 1 : request.derivatives == 1 ? 3 : 6;
  if (double(addresses.size()) * lattice.size() > std::numeric_limits<std::int32_t>::max()) return std::nullopt;

  Pieces pieces;
  pieces.matches = matches_of(patterns, control, addresses.size(), [&](Index address) {
    const Addresses::Place at = addresses.place(address);
    if (at.corner >= 0) return Piece{Piece::Kind::cut, t.corner(at.face, at.corner)};
    return Piece{addresses.triangles() ? Piece::Kind::triangle : Piece::Kind::quad, t.first(at.face)};
  });
  Blocks blocks;
  std::vector<Patch> patches(addresses.size());
  for (Index a = 0; a < addresses.size(); ++a) {
    const LatticePlace place{a, static_cast<std::int8_t>(pieces.matches[a].turn), -1};
    const bool hole = control.holes[index(addresses.place(a).face)];
    patches[a] = {blocks.add({pieces.matches[a].type, place}), static_cast<std::uint8_t>(hole), a};
  }
  const double bytes = blocks.num_bytes(double(arrays.quantities) * lattice.size());
  if (bytes > most_bytes) return std::nullopt;
  check_memory(std::to_string(blocks.keys().size()) + " blocks of " + std::to_string(lattice.size()) + " places",
               4 * bytes, "use fewer places");
  const auto limit_block = [&](const Blocks::Key& key) {
    return patterns.limit_block(*key.type, lattice, key.place, true, request.derivatives);
  };
  const bool made = blocks.fill(arrays, lattice.size(), [&](const Blocks::Key& key) -> const RowMatrix* {
    const Patterns::LimitBlock* block = limit_block(key);
    return block ? &block->weights : nullptr;
  });
  if (!made) return std::nullopt;

  std::sort(patches.begin(), patches.end(), by_block);
  std::vector<std::int32_t> all(lattice.size());
  for (std::int32_t i = 0; i < lattice.size(); ++i) all[i] = i;
  Groups groups;
  std::vector<std::uint8_t> row_status;
  std::vector<std::int64_t> patch_points;
  for (size_t at = 0; at < patches.size();) {
    const auto [block, hole, ignored] = patches[at];
    groups.begin(block, all);
    for (; at < patches.size() && patches[at].block == block && patches[at].share == hole; ++at) {
      groups.add(pieces.matches[patches[at].piece].vertices);
      patch_points.push_back(std::int64_t{patches[at].piece} * lattice.size());
    }
    groups.end();
    const std::vector<std::uint8_t>& status = limit_block(blocks.keys()[block])->status;
    for (const std::uint8_t s : status) row_status.push_back(hole ? std::uint8_t(LimitStatus::hole) : s);
  }
  std::vector<std::int32_t> copies;
  for (const auto& [to, from] : shared_grid_places(t, addresses, request.grid)) {
    copies.push_back(static_cast<std::int32_t>(to));
    copies.push_back(static_cast<std::int32_t>(from));
  }
  arrays.groups = std::move(groups.groups);
  arrays.rows = std::move(groups.rows);
  arrays.columns = std::move(groups.columns);
  arrays.patch_points = std::move(patch_points);
  arrays.copies = std::move(copies);
  if (std::any_of(row_status.begin(), row_status.end(), [](std::uint8_t s) { return s != 0; }))
    baked.table.row_status = std::move(row_status);
  baked.table.table = PatternTable<double>(t.num_vertices(), std::move(arrays));
  baked.statistics.faces = addresses.size();
  baked.statistics.types = blocks.num_types();
  return baked;
}

}  // namespace

std::optional<Baked> bake_by_patterns(Patterns& patterns, const Level& control, const BakeRequest& request,
                                      bool first_by_rows, double most_bytes) {
  std::optional<Baked> baked;
  if (request.rows == TableRows::level || request.rows == TableRows::limit)
    baked = bake_lattices(patterns, control, request, first_by_rows, most_bytes);
  else if (request.rows == TableRows::grid && !first_by_rows)
    baked = bake_grids(patterns, control, request, most_bytes);
  if (baked) baked->statistics.method = first_by_rows ? BakeMethod::rows_then_patterns : BakeMethod::patterns;
  return baked;
}

}  // namespace sublimit
