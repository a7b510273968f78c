// SPDX-License-Identifier: Apache-2.0
#include "sublimit/bake_patterns.h"

#include <algorithm>
#include <atomic>
#include <array>
#include <limits>
#include <tuple>
#include <unordered_map>

#include "sublimit/analysis/limit_status.h"
#include "sublimit/bake_rows.h"
#include "sublimit/base/error.h"
#include "sublimit/base/memory.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/face_owners.h"
#include "sublimit/face_places.h"
#include "sublimit/limit/limit_surface.h"
#include "sublimit/piece_matches.h"

namespace sublimit {
namespace {

using Arrays = PatternTable<double>::Arrays;

/// Blocks of a table, in the order in which pieces meet them, made in parallel.
class Blocks {
 public:
  struct Key {
    const Pattern* pattern = nullptr;
    LatticePlace place;  ///< where it matters: its turn and quarter
    bool operator==(const Key& other) const {
      return pattern == other.pattern && place.turn == other.place.turn && place.quarter == other.place.quarter;
    }
  };
  /// @param piece  that has it
  Index add(const Key& key, Index piece) {
    if (!keys_.empty() && keys_[last_] == key) return last_;  // on large meshes most are like the one before
    const auto [at, is_new] = numbers_.try_emplace(key, static_cast<Index>(keys_.size()));
    if (is_new) {
      keys_.push_back(key);
      pieces_.push_back(piece);
    }
    return last_ = at->second;
  }
  const std::vector<Key>& keys() const { return keys_; }
  Index count() const { return static_cast<Index>(keys_.size()); }
  /// The first piece that has it.
  Index piece(Index block) const { return pieces_[block]; }

  /// @param rows       points of a block
  /// @param make       weights of a block, or null: those of types whose sums have an order are asked for in turn
  /// @return  false if one is null
  template <class Make>
  bool fill(Arrays& arrays, std::int32_t rows, const Make& make) const {
    std::vector<const RowMatrix*> made(keys_.size());
    std::atomic<bool> failed = false;
    const auto made_or_null = [&](Index i) -> const RowMatrix* {
      try {
        if (!failed) return make(i);
      } catch (const AnalysisError&) {
        failed = true;  // a neighbourhood that never comes to repeat itself: rows may know what to do
      }
      return nullptr;
    };
    for (Index i = 0; i < count(); ++i)
      if (keys_[i].pattern->decays) made[i] = made_or_null(i);
    parallel_for_blocks(
        static_cast<std::int64_t>(keys_.size()),
        [&](std::int64_t i, std::int64_t, std::int64_t) {
          if (!made[i]) made[i] = made_or_null(static_cast<Index>(i));
        },
        1);
    if (std::find(made.begin(), made.end(), nullptr) != made.end()) return false;
    size_t size = 0;
    for (const RowMatrix* W : made) size += size_t(W->size());
    std::vector<double> weights;
    weights.reserve(size);
    for (const RowMatrix* W : made) {
      arrays.blocks.push_back({rows, static_cast<std::int32_t>(W->cols()), static_cast<std::int64_t>(weights.size())});
      weights.insert(weights.end(), W->data(), W->data() + W->size());
    }
    arrays.weights = std::move(weights);
    return true;
  }
  double num_bytes(double rows) const {
    double bytes = 0;
    for (const Key& key : keys_) bytes += rows * key.pattern->num_slots * sizeof(double);
    return bytes;
  }

 private:
  struct Hash {
    size_t operator()(const Key& key) const {
      return key.pattern->number * 128 + size_t(8 * (key.place.quarter + 1) + key.place.turn);
    }
  };
  std::unordered_map<Key, Index, Hash> numbers_;
  std::vector<Key> keys_;
  std::vector<Index> pieces_;
  Index last_ = 0;
};

Index num_types(const PieceMatches& pieces) {
  std::vector<size_t> numbers;
  for (Index i = 0; i < pieces.count(); ++i)
    if (const size_t number = pieces.pattern(i).number; numbers.empty() || number != numbers.back())
      numbers.push_back(number);
  std::sort(numbers.begin(), numbers.end());
  return static_cast<Index>(std::unique(numbers.begin(), numbers.end()) - numbers.begin());
}

/// Patches by block and share, those of a group in the order of their pieces.
class Groups {
 public:
  /// @param block  of a piece; -1: it makes no points
  /// @param share  of a piece: what it has of its block's rows
  Groups(const PieceMatches& pieces, std::span<const Index> block, std::span<const std::uint8_t> share) {
    const Index count = pieces.count();
    std::unordered_map<std::int64_t, Index> numbers;
    std::int64_t last = -1;
    Index number = -1;
    for (Index i = 0; i < count; ++i) {
      if (block[i] < 0) continue;
      const std::int64_t key = std::int64_t{block[i]} * 256 + share[i];
      if (key != last) {
        const auto [at, is_new] = numbers.try_emplace(key, static_cast<Index>(groups.size()));
        if (is_new) groups.push_back({block[i], share[i], {}});
        number = at->second;
        last = key;
      }
      groups[number].pieces.push_back(i);
    }
    std::sort(groups.begin(), groups.end(),
              [](const Group& a, const Group& b) { return std::tie(a.block, a.share) < std::tie(b.block, b.share); });
  }

  struct Group {
    Index block;
    std::uint8_t share;
    std::vector<Index> pieces;
  };
  std::vector<Group> groups;
};

/// Control points of all patches, those of isolated points last.
std::vector<std::int32_t> all_columns(const PieceMatches& pieces, const Groups& groups, std::span<const Index> alone) {
  struct Run {
    std::int64_t first;  // where its control points begin
    const Index* pieces;
    std::int64_t count;
  };
  constexpr std::int64_t per_run = 1024;
  std::vector<Run> runs;
  std::int64_t next = 0;
  for (const Groups::Group& group : groups.groups)
    for (size_t at = 0; at < group.pieces.size(); at += per_run) {
      const std::int64_t count = std::min<std::int64_t>(per_run, std::int64_t(group.pieces.size() - at));
      runs.push_back({next, group.pieces.data() + at, count});
      next += count * std::int64_t(pieces.vertices(group.pieces[at]).size());
    }
  std::vector<std::int32_t> columns(size_t(next) + alone.size());
  parallel_for_blocks(
      std::int64_t(runs.size()),
      [&](std::int64_t r, std::int64_t, std::int64_t) {
        std::int32_t* out = columns.data() + runs[r].first;
        for (std::int64_t i = 0; i < runs[r].count; ++i) {
          const std::span<const Index> vertices = pieces.vertices(runs[r].pieces[i]);
          out = std::copy(vertices.begin(), vertices.end(), out);
        }
      },
      1);
  std::copy(alone.begin(), alone.end(), columns.begin() + next);
  return columns;
}

/// What groups take, without making them.
/// @param rows    points of a block
/// @param length  rows of a share
template <class Length>
void count(const Blocks& blocks, const Groups& groups, double rows, const Length& length, BakeStatistics& s) {
  std::int64_t chosen = 0, columns = 0;
  for (const Groups::Group& group : groups.groups) {
    const std::int64_t own = length(group.share);
    columns += std::ssize(group.pieces) * blocks.keys()[group.block].pattern->num_slots;
    s.points += std::ssize(group.pieces) * own;
    chosen += own;
    ++s.groups;
  }
  s.blocks = blocks.count();
  s.weights = static_cast<std::int64_t>(blocks.num_bytes(rows)) / std::int64_t(sizeof(double));
  s.bytes = std::int64_t(sizeof(double)) * s.weights + 4 * (chosen + columns) +
            std::int64_t(sizeof(PatternTable<double>::Block)) * s.blocks +
            std::int64_t(sizeof(PatternTable<double>::Group)) * s.groups;
}

/// Those that have a block of their own.
void count_isolated(const Topology& t, int quantities, BakeStatistics& s) {
  std::int64_t alone = 0;
  for (Index v = 0; v < t.num_vertices(); ++v) alone += t.is_isolated(Vertex{v});
  if (alone == 0) return;
  ++s.blocks;
  ++s.groups;
  s.points += alone;
  s.weights += quantities;
  s.bytes += std::int64_t(sizeof(double)) * quantities + 4 * (1 + alone) +
             std::int64_t(sizeof(PatternTable<double>::Block) + sizeof(PatternTable<double>::Group));
}

/// Vertices of level k, or their limits: points are shared between faces.
std::optional<Baked> bake_lattices(Patterns& patterns, const Level& control, const BakeRequest& request,
                                   const PatternBake& how) {
  const bool first_by_rows = how.first_by_rows;
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

  const auto piece_at = [&](Index f) { return Piece{kind, t.first(Face{f})}; };
  const PieceMatches pieces(patterns, level, t.num_faces(), piece_at);
  std::vector<std::int8_t> turn(t.num_faces());
  for (Index f = 0; f < t.num_faces(); ++f) turn[f] = static_cast<std::int8_t>(pieces.turn(f));
  std::vector<LatticePlace> places;
  if (!first_by_rows)
    places = places_of_faces(turn);
  else if (auto of_children = places_of_children(scheme, control, level, turn))
    places = std::move(*of_children);
  if (request.derivatives > 0 && places.empty() && t.num_faces() > 0) return std::nullopt;

  FaceLattices::Arrays lattices = face_owners(t, lattice, turn, how.owners);
  std::vector<std::uint8_t> share(t.num_faces());
  parallel_for(t.num_faces(), [&](std::int64_t f) { share[f] = FaceLattices::share(lattices, static_cast<Index>(f)); });
  // On coarse lattices all points of a face may be others'.
  std::array<bool, 256> has_points{};
  const bool has_inner = !FaceLattices::rows(lattice, 0).empty();
  for (size_t own = 0; own < has_points.size(); ++own)
    has_points[own] = has_inner || !FaceLattices::rows(lattice, static_cast<std::uint8_t>(own)).empty();
  Blocks blocks;
  std::vector<Index> block_of(t.num_faces(), -1);
  for (Index f = 0; f < t.num_faces(); ++f)
    if (has_points[share[f]])
      block_of[f] = blocks.add({&pieces.pattern(f), request.derivatives > 0 ? places[f] : LatticePlace{}}, f);
  const double bytes = blocks.num_bytes(double(arrays.quantities) * lattice.size());
  if (bytes > how.most_bytes) return std::nullopt;
  check_memory(std::to_string(blocks.keys().size()) + " blocks of level " + std::to_string(request.level), 4 * bytes,
               "use fewer levels");
  const Groups groups(pieces, block_of, share);
  if (how.only_count) {
    BakeStatistics& s = baked.statistics;
    count(
        blocks, groups, double(arrays.quantities) * lattice.size(),
        [&](std::uint8_t own) { return std::ssize(FaceLattices::rows(lattice, own)); }, s);
    s.faces = t.num_faces();
    s.types = num_types(pieces);
    count_isolated(t, arrays.quantities, s);
    if (arrays.first) {
      s.weights += std::int64_t(arrays.first->weights().size());
      s.bytes += arrays.first->num_bytes();
    }
    return baked;
  }
  const bool has_status = limit && request.derivatives > 0;
  std::vector<const std::vector<std::uint8_t>*> status(blocks.keys().size(), nullptr);
  const bool made = blocks.fill(arrays, lattice.size(), [&](Index b) -> const RowMatrix* {
    const auto& [pattern, place] = blocks.keys()[b];
    const Index f = blocks.piece(b);
    const Patterns::Example example{level, piece_at(f), pieces.turn(f)};
    if (!limit) return &patterns.rows(*pattern, example, levels);
    if (request.derivatives == 0) return &patterns.limit_rows(*pattern, example, levels);
    const Patterns::LimitBlock* block =
        patterns.limit_block(*pattern, example, {lattice, place, false, request.derivatives});
    if (!block) return nullptr;
    status[b] = &block->status;
    return &block->weights;
  });
  if (!made) return std::nullopt;

  // Isolated vertices stay where they are.
  std::vector<std::int32_t> rows;
  std::vector<std::uint8_t> row_status;
  std::vector<std::int64_t> first_points(t.num_faces());
  std::int64_t next = 0;
  for (const Groups::Group& group : groups.groups) {
    const std::vector<std::int32_t> own = FaceLattices::rows(lattice, group.share);
    for (const Index f : group.pieces) {
      first_points[f] = next;
      next += std::int64_t(own.size());
    }
    arrays.groups.push_back({group.block, static_cast<std::int32_t>(own.size()), static_cast<std::int64_t>(rows.size()),
                             std::int64_t(group.pieces.size())});
    rows.insert(rows.end(), own.begin(), own.end());
    if (has_status)
      for (const std::int32_t row : own) row_status.push_back((*status[group.block])[row]);
  }
  std::vector<Index> alone;
  for (Index v = 0; v < t.num_vertices(); ++v)
    if (t.is_isolated(Vertex{v})) alone.push_back(v);
  if (!alone.empty()) {
    std::vector<double> weights(arrays.weights.begin(), arrays.weights.end());
    arrays.groups.push_back({static_cast<std::int32_t>(arrays.blocks.size()), 1, static_cast<std::int64_t>(rows.size()),
                             std::int64_t(alone.size())});
    arrays.blocks.push_back({1, 1, static_cast<std::int64_t>(weights.size())});
    weights.push_back(1);
    weights.resize(weights.size() + size_t(arrays.quantities) - 1, 0.0);
    arrays.weights = std::move(weights);
    rows.push_back(0);
    if (has_status) row_status.push_back(std::uint8_t(LimitStatus::undefined_normal));
  }
  arrays.columns = all_columns(pieces, groups, alone);
  arrays.rows = std::move(rows);
  baked.table.row_status = std::move(row_status);
  baked.table.table = PatternTable<double>(control.topology().num_vertices(), std::move(arrays));

  if (!places.empty()) {
    std::vector<std::int32_t> addresses;
    std::vector<std::uint8_t> codes;
    for (const LatticePlace& place : places) {
      addresses.push_back(place.address);
      codes.push_back(static_cast<std::uint8_t>(place.turn + 8 * (place.quarter + 1)));
    }
    lattices.addresses = std::move(addresses);
    lattices.places = std::move(codes);
  }
  lattices.first_points = std::move(first_points);
  if (std::find(level.holes.begin(), level.holes.end(), true) != level.holes.end())
    lattices.holes = std::vector<std::uint8_t>(level.holes.begin(), level.holes.end());
  baked.table.lattices.emplace(baked.table.table.num_points(), std::move(lattices));
  baked.statistics.faces = t.num_faces();
  baked.statistics.types = num_types(pieces);
  if (how.turns) *how.turns = std::move(turn);
  return baked;
}

/// The same places on every address: each has all of its points, and positions on sides are copied.
std::optional<Baked> bake_grids(Patterns& patterns, const Level& control, const BakeRequest& request,
                                const PatternBake& how) {
  const Scheme<double>& scheme = patterns.scheme();
  const Topology& t = control.topology();
  if (scheme.is_dual() || (!scheme.preparation.empty() && t.uniform_face_size() != scheme.corners)) return std::nullopt;
  const Addresses addresses(t, scheme.face_size() == 3);
  const Lattice lattice{request.grid - 1, addresses.triangles()};
  Baked baked;
  Arrays arrays;
  arrays.quantities = request.derivatives == 0 ? 1 : request.derivatives == 1 ? 3 : 6;
  if (double(addresses.size()) * lattice.size() > std::numeric_limits<std::int32_t>::max()) return std::nullopt;

  const auto piece_at = [&](Index address) {
    const Addresses::Place at = addresses.place(address);
    if (at.corner >= 0) return Piece{Piece::Kind::cut, t.corner(at.face, at.corner)};
    return Piece{addresses.triangles() ? Piece::Kind::triangle : Piece::Kind::quad, t.first(at.face)};
  };
  const PieceMatches pieces(patterns, control, addresses.size(), piece_at);
  Blocks blocks;
  std::vector<Index> block_of(addresses.size());
  std::vector<std::uint8_t> is_hole(addresses.size());
  for (Index a = 0; a < addresses.size(); ++a) {
    block_of[a] = blocks.add({&pieces.pattern(a), {a, static_cast<std::int8_t>(pieces.turn(a)), -1}}, a);
    is_hole[a] = control.holes[index(addresses.place(a).face)];
  }
  const double bytes = blocks.num_bytes(double(arrays.quantities) * lattice.size());
  if (bytes > how.most_bytes) return std::nullopt;
  check_memory(std::to_string(blocks.keys().size()) + " blocks of " + std::to_string(lattice.size()) + " places",
               4 * bytes, "use fewer places");
  const Groups groups(pieces, block_of, is_hole);
  if (how.only_count) {
    BakeStatistics& s = baked.statistics;
    count(
        blocks, groups, double(arrays.quantities) * lattice.size(), [&](std::uint8_t) { return lattice.size(); }, s);
    s.faces = addresses.size();
    s.types = num_types(pieces);
    s.bytes += 8 * (std::int64_t(pieces.count()) + std::ssize(shared_grid_places(t, addresses, request.grid, false)));
    return baked;
  }
  const auto limit_block = [&](Index b) {
    const auto& [pattern, place] = blocks.keys()[b];
    const Index a = blocks.piece(b);
    return patterns.limit_block(*pattern, {control, piece_at(a), pieces.turn(a)},
                                {lattice, place, true, request.derivatives});
  };
  const bool made = blocks.fill(arrays, lattice.size(), [&](Index b) -> const RowMatrix* {
    const Patterns::LimitBlock* block = limit_block(b);
    return block ? &block->weights : nullptr;
  });
  if (!made) return std::nullopt;

  std::vector<std::int32_t> rows;
  std::vector<std::uint8_t> row_status;
  std::vector<std::int64_t> patch_points;
  for (const Groups::Group& group : groups.groups) {
    arrays.groups.push_back(
        {group.block, lattice.size(), static_cast<std::int64_t>(rows.size()), std::int64_t(group.pieces.size())});
    for (const Index a : group.pieces) patch_points.push_back(std::int64_t{a} * lattice.size());
    for (std::int32_t i = 0; i < lattice.size(); ++i) rows.push_back(i);
    const std::vector<std::uint8_t>& status = limit_block(group.block)->status;
    for (const std::uint8_t s : status) row_status.push_back(group.share ? std::uint8_t(LimitStatus::hole) : s);
  }
  std::vector<std::int32_t> copies;
  for (const auto& [to, from] : shared_grid_places(t, addresses, request.grid, false)) {
    copies.push_back(static_cast<std::int32_t>(to));
    copies.push_back(static_cast<std::int32_t>(from));
  }
  arrays.rows = std::move(rows);
  arrays.columns = all_columns(pieces, groups, {});
  arrays.patch_points = std::move(patch_points);
  arrays.copies = std::move(copies);
  if (std::any_of(row_status.begin(), row_status.end(), [](std::uint8_t s) { return s != 0; }))
    baked.table.row_status = std::move(row_status);
  baked.table.table = PatternTable<double>(t.num_vertices(), std::move(arrays));
  baked.statistics.faces = addresses.size();
  baked.statistics.types = num_types(pieces);
  return baked;
}

}  // namespace

std::optional<Baked> bake_by_patterns(Patterns& patterns, const Level& control, const BakeRequest& request,
                                      const PatternBake& how) {
  std::optional<Baked> baked;
  if (request.rows == TableRows::level || request.rows == TableRows::limit)
    baked = bake_lattices(patterns, control, request, how);
  else if (request.rows == TableRows::grid && !how.first_by_rows)
    baked = bake_grids(patterns, control, request, how);
  if (baked) baked->statistics.method = how.first_by_rows ? BakeMethod::rows_then_patterns : BakeMethod::patterns;
  return baked;
}

}  // namespace sublimit
