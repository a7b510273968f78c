// SPDX-License-Identifier: Apache-2.0
// Vertices of level k of dual schemes, or their limits: each is a point of one corner of a control face, and no points
// are shared.
#include "sublimit/base/detail/memory.h"
#include "sublimit/scheme/detail/refine_impl.h"
#include "sublimit/stencils/bake/detail/bake_patterns.h"
#include "sublimit/stencils/bake/detail/bake_rows.h"
#include "sublimit/stencils/bake/detail/pattern_counts.h"

namespace sublimit {
namespace {

/// Vertices of the last level by the control corners that have them.
class CornerVertices {
 public:
  /// @param levels  a level of the pieces and the steps to the next such level, and so on
  CornerVertices(const Level& control, const std::vector<std::vector<Level>>& periods)
      : control_(control), periods_(periods) {
    for (const std::vector<Level>& period : periods) {
      std::vector<LevelStep>& steps = steps_.emplace_back();
      for (const Level& level : period)
        for (const Refinement& step : level.steps) steps.push_back({&step, level.number - 1});
    }
  }
  /// Calls body(vertex) for those of a corner, in the order of `Patterns::rows`.
  template <class Body>
  void for_each(HalfEdge corner, const Body& body, size_t period = 0) const {
    const Topology& parent = period == 0 ? control_.topology() : periods_[period - 1].back().topology();
    const Topology& t = periods_[period].back().topology();
    const bool is_last = period + 1 == periods_.size();
    const std::vector<PieceChild> all = children({Piece::Kind::corner, corner}, parent, steps_[period]);
    std::vector<Vertex> begun;
    for (const PieceChild& child : all) {
      if (child.map.is_repeated()) continue;
      const Vertex v = t.tail(child.piece.start);
      if (!is_last)
        for_each(child.piece.start, body, period + 1);
      else if (std::find(begun.begin(), begun.end(), v) == begun.end())
        body(v), begun.push_back(v);
    }
  }

 private:
  const Level& control_;
  const std::vector<std::vector<Level>>& periods_;
  std::vector<std::vector<LevelStep>> steps_;
};

std::vector<std::vector<Level>> refined_topologies(const Scheme<double>& scheme, const Level& control, int levels) {
  std::vector<std::vector<Level>> periods;
  const Level* last = &control;
  for (int k = 0; k < levels; ++k) {
    if (k % scheme.period == 0) periods.emplace_back().reserve(size_t(scheme.period));
    periods.back().push_back(next_topology(scheme, *last, [](const auto&...) {}));
    last = &periods.back().back();
  }
  return periods;
}

}  // namespace

std::optional<Baked> bake_corners(Patterns& patterns, const Level& control, const BakeRequest& request,
                                  const PatternBake& how) {
  const Scheme<double>& scheme = patterns.scheme();
  if (how.first_by_rows || request.level == 0 || request.level % scheme.period != 0 || request.derivatives > 0)
    return std::nullopt;
  const Topology& t = control.topology();
  const bool limit = request.rows == TableRows::limit;
  const auto piece_at = [](Index h) { return Piece{Piece::Kind::corner, HalfEdge{h}}; };
  const PieceMatches pieces(patterns, control, t.num_half_edges(), piece_at, how.must_pay);
  if (!pieces.pays()) return std::nullopt;
  PatternBlocks blocks(scheme);
  std::vector<Index> block_of(size_t(pieces.count()));
  for (Index i = 0; i < pieces.count(); ++i) block_of[i] = blocks.add({&pieces.pattern(i), {}}, i);
  const auto example = [&](Index b) { return Patterns::Example{control, piece_at(blocks.piece(b)), 0}; };
  std::vector<std::int64_t> num_rows;
  for (Index b = 0; b < blocks.count(); ++b)
    num_rows.push_back(patterns.num_corner_rows(*blocks.keys()[b].pattern, example(b), request.level));
  const auto rows_of_block = [&](Index b) { return num_rows[b]; };
  const double bytes = blocks.num_bytes(rows_of_block);
  if (bytes > how.most_bytes) return std::nullopt;
  check_memory(std::to_string(blocks.count()) + " blocks of level " + std::to_string(request.level), 4 * bytes,
               "use fewer levels");
  const std::vector<std::uint8_t> no_share(size_t(pieces.count()), 0);
  const PatchGroups groups(pieces, block_of, no_share);
  Baked baked;
  BakeStatistics& s = baked.statistics;
  s.faces = t.num_faces();
  s.types = num_types(pieces);
  PatternTable<double>::Arrays arrays;
  if (how.only_count) {
    count(
        blocks, groups, rows_of_block, [&](const PatchGroups::Group& group) { return num_rows[group.block]; }, s);
    return baked;
  }
  const bool made = blocks.fill(
      arrays, [&](Index b) { return static_cast<std::int32_t>(num_rows[b]); },
      [&](Index b) {
        const Pattern& pattern = *blocks.keys()[b].pattern;
        return limit ? &patterns.limit_rows(pattern, example(b), request.level)
                     : &patterns.rows(pattern, example(b), request.level);
      });
  if (!made) return std::nullopt;

  std::vector<std::int32_t> rows;
  std::vector<std::int64_t> first_points(size_t(pieces.count()));
  std::int64_t next = 0;
  for (const PatchGroups::Group& group : groups.groups) {
    arrays.groups.push_back(
        {group.block, static_cast<std::int32_t>(num_rows[group.block]), std::ssize(rows), std::ssize(group.pieces)});
    for (std::int32_t row = 0; row < num_rows[group.block]; ++row) rows.push_back(row);
    for (const Index i : group.pieces) {
      first_points[i] = next;
      next += num_rows[group.block];
    }
  }
  arrays.columns = all_columns(pieces, blocks, groups, {});
  arrays.rows = std::move(rows);
  baked.table.table = PatternTable<double>(t.num_vertices(), std::move(arrays));

  const std::vector<std::vector<Level>> periods = refined_topologies(scheme, control, request.level);
  const Level& last = periods.back().back();
  const CornerVertices vertices(control, periods);
  std::vector<std::int32_t> point_of(size_t(last.topology().num_vertices()), -1);
  parallel_for(pieces.count(), [&](std::int64_t i) {
    std::int64_t point = first_points[i];
    vertices.for_each(HalfEdge{static_cast<Index>(i)},
                      [&](Vertex v) { point_of[index(v)] = static_cast<std::int32_t>(point++); });
  });
  if (next != std::ssize(point_of) || std::find(point_of.begin(), point_of.end(), -1) != point_of.end())
    return std::nullopt;
  const FaceList faces = face_list(last);
  std::vector<std::int32_t> corners(faces.corners.begin(), faces.corners.end());
  for (std::int32_t& corner : corners) corner = point_of[corner];
  baked.table.faces = {faces.sizes, std::move(corners)};
  return baked;
}

}  // namespace sublimit
