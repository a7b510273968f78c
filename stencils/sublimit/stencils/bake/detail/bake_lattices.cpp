// SPDX-License-Identifier: Apache-2.0
// Vertices of level k, or their limits: points are shared between faces.
#include <algorithm>
#include <array>
#include <numeric>

#include "sublimit/base/detail/memory.h"
#include "sublimit/mesh/detail/topology_builder.h"
#include "sublimit/stencils/bake/detail/bake_patterns.h"
#include "sublimit/stencils/bake/detail/bake_rows.h"
#include "sublimit/stencils/bake/detail/face_places.h"
#include "sublimit/stencils/bake/detail/pattern_counts.h"
#include "sublimit/stencils/patterns/point_status.h"

namespace sublimit {
namespace {

/// Leaves what `PieceMatches::points` asks for: half-edges and faces.
void keep_corners_only(Level& level) {
  Topology& topology = level.steps.back().topology;
  topology = TopologyBuilder::corners_only(std::move(topology));
  level.sharpness = {};
}

/// The control level's face of each face of the level that has the patterns.
/// @param of_children  places of these, if they are children
std::vector<Index> control_faces(const Level& control, const std::optional<std::vector<LatticePlace>>& of_children) {
  const Topology& t = control.topology();
  std::vector<Index> faces;
  if (!of_children) {
    faces.resize(size_t(t.num_faces()));
    std::iota(faces.begin(), faces.end(), 0);
    return faces;
  }
  const Addresses addresses(t, false);
  faces.reserve(of_children->size());
  for (const LatticePlace& place : *of_children) faces.push_back(index(addresses.place(place.address).face));
  return faces;
}

}  // namespace

std::optional<Baked> bake_lattices(Patterns& patterns, const Level& control, const BakeRequest& request,
                                   const PatternBake& how) {
  const bool first_by_rows = how.first_by_rows;
  const Scheme<double>& scheme = patterns.scheme();
  if (!Patterns::is_possible(scheme)) return std::nullopt;
  const Index sides = scheme.face_size() == 3 ? 3 : 4;
  const int levels = request.level - (first_by_rows ? 1 : 0);
  if (levels < 0 || (!first_by_rows && control.topology().uniform_face_size() != sides)) return std::nullopt;
  const bool limit = request.rows == TableRows::limit;
  // Between levels whose neighbourhoods lie alike. Thirds of a side are no binary numbers, and places of derivatives
  // would be beside the points; face-varying values and tags are found on faces cut in four; and where sheets meet in
  // an edge, each has points of its own there.
  const bool turns = scheme.period > 1;
  if (turns && (first_by_rows || request.level % scheme.period != 0 || request.derivatives > 0 ||
                needs_refined_mesh(request) || !control.topology().is_manifold()))
    return std::nullopt;

  Baked baked;
  PatternTable<double>::Arrays arrays;
  arrays.quantities = num_quantities(request.derivatives);
  std::optional<Level> refined;
  if (first_by_rows) {
    refined = next_level(scheme, control);
    arrays.first = as_table(refined->S);
    SparseMatrix().swap(refined->S);
  }
  const Level& level = refined ? *refined : control;
  const Topology& t = level.topology();
  const Lattice lattice = Patterns::lattice_of(scheme, levels);
  const auto kind = sides == 3 ? Piece::Kind::triangle : Piece::Kind::quad;

  const auto piece_at = [&](Index f) { return Piece{kind, t.first(Face{f})}; };
  const PieceMatches pieces(patterns, level, t.num_faces(), piece_at, how.must_pay);
  if (!pieces.pays()) return std::nullopt;
  std::vector<std::int8_t> turn(t.num_faces());
  for (Index f = 0; f < t.num_faces(); ++f) turn[f] = static_cast<std::int8_t>(pieces.turn(f));
  std::optional<std::vector<LatticePlace>> of_children;
  if (first_by_rows) of_children = places_of_children(scheme, control, level, turn);
  const bool has_places = !first_by_rows || of_children;
  if ((request.derivatives > 0 || how.owned) && !has_places) return std::nullopt;
  const auto place_of = [&](Index f) { return of_children ? (*of_children)[f] : LatticePlace{f, turn[f], -1}; };

  FaceLattices::Arrays lattices = face_owners(t, lattice, turn, how.owners);
  std::vector<std::uint8_t> share(t.num_faces());
  parallel_for(t.num_faces(), [&](std::int64_t f) { share[f] = FaceLattices::share(lattices, static_cast<Index>(f)); });
  // On coarse lattices all points of a face may be others'.
  std::array<bool, 256> has_points{};
  const bool has_inner = !LatticeRanks::rows(lattice, 0).empty();
  for (size_t own = 0; own < has_points.size(); ++own)
    has_points[own] = has_inner || !LatticeRanks::rows(lattice, static_cast<std::uint8_t>(own)).empty();
  PatternBlocks blocks(scheme);
  std::vector<Index> block_of(t.num_faces(), -1);
  std::vector<Index> control_face = how.owned ? control_faces(control, of_children) : std::vector<Index>();
  for (Index f = 0; f < t.num_faces(); ++f)
    if (has_points[share[f]] && (!how.owned || (*how.owned)[size_t(control_face[f])]))
      block_of[f] = blocks.add({&pieces.pattern(f), request.derivatives > 0 ? place_of(f) : LatticePlace{}}, f);
  const auto rows_of_block = [&](Index) { return arrays.quantities * lattice.size(); };
  const double bytes = blocks.num_bytes(rows_of_block);
  if (bytes > how.most_bytes) return std::nullopt;
  check_memory(std::to_string(blocks.keys().size()) + " blocks of level " + std::to_string(request.level), 4 * bytes,
               "use fewer levels");
  const PatchGroups groups(pieces, block_of, share);
  std::vector<Index>().swap(block_of);
  if (how.only_count) {
    BakeStatistics& s = baked.statistics;
    count(
        blocks, groups, rows_of_block,
        [&](const PatchGroups::Group& group) { return std::ssize(LatticeRanks::rows(lattice, group.share)); }, s);
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
  const bool made = blocks.fill(
      arrays, [&](Index) { return lattice.size(); },
      [&](Index b) -> const RowMatrix* {
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

  std::vector<std::int32_t> rows;
  std::vector<std::uint8_t> row_status;
  for (const PatchGroups::Group& group : groups.groups) {
    const std::vector<std::int32_t> own = LatticeRanks::rows(lattice, group.share);
    arrays.groups.push_back({group.block, static_cast<std::int32_t>(own.size()), static_cast<std::int64_t>(rows.size()),
                             std::int64_t(group.pieces.size())});
    rows.insert(rows.end(), own.begin(), own.end());
    if (has_status)
      for (const std::int32_t row : own) row_status.push_back((*status[group.block])[row]);
  }
  // Isolated vertices stay where they are.
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
    if (has_status) row_status.push_back(point_status(LimitStatus::undefined_normal, 0, request.derivatives));
  }
  baked.statistics.faces = t.num_faces();
  baked.statistics.types = num_types(pieces);
  const Index num_control_points = control.topology().num_vertices();
  // Of a large mesh connectivity and lists of the table are the most there is: as one goes the other comes.
  Level* const spent = refined ? &*refined : how.spent;
  if (spent) keep_corners_only(*spent);
  arrays.columns = all_columns(pieces, blocks, groups, alone);
  if (spent) spent->steps.clear();

  std::vector<std::int64_t> first_points(turn.size());
  std::int64_t next = 0;
  for (size_t g = 0; g < groups.groups.size(); ++g)
    for (const Index f : groups.groups[g].pieces) {
      first_points[f] = next;
      next += arrays.groups[g].num_rows;
      if (how.patches) how.patches->push_back({f, turn[size_t(f)], share[size_t(f)], control_face[f]});
    }
  if (!how.owned) lattices.first_points = std::move(first_points);
  arrays.rows = std::move(rows);
  baked.table.row_status = std::move(row_status);
  baked.table.table = PatternTable<double>(num_control_points, std::move(arrays));
  if (has_places && !how.owned) {
    std::vector<std::int32_t> addresses(turn.size());
    std::vector<std::uint8_t> codes(turn.size());
    for (size_t f = 0; f < turn.size(); ++f) {
      const LatticePlace at = place_of(static_cast<Index>(f));
      addresses[f] = at.address;
      codes[f] = FaceLattices::code(at);
    }
    lattices.addresses = std::move(addresses);
    lattices.places = std::move(codes);
  }
  if (std::find(level.holes.begin(), level.holes.end(), true) != level.holes.end())
    lattices.holes = std::vector<std::uint8_t>(level.holes.begin(), level.holes.end());
  if (!how.owned)
    baked.table.lattices.emplace(baked.table.table.num_points(), std::move(lattices));
  else if (how.lattices)
    *how.lattices = {std::move(lattices), std::move(control_face)};
  if (how.turns) *how.turns = std::move(turn);
  return baked;
}

}  // namespace sublimit
