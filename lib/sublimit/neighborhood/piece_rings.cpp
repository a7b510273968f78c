// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/piece_rings.h"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/neighborhood/local_patch.h"
#include "sublimit/neighborhood/piece_walk.h"
#include "sublimit/scheme/detail/mask_reach.h"

namespace sublimit {
namespace {

/// The steps of some levels that follow each other.
std::vector<LevelStep> steps_of(std::span<const Level> levels) {
  std::vector<LevelStep> steps;
  for (const Level& level : levels)
    for (const Refinement& step : level.steps) steps.push_back({&step, level.number - 1});
  return steps;
}

/// A labelled level after one period.
struct Refined {
  SparseMatrix S;
  std::vector<LevelStep> steps;
  explicit Refined(const std::vector<Level>& period) : S(period[0].S), steps(steps_of(period)) {
    for (size_t k = 1; k < period.size(); ++k) S = product(period[k].S, S);
  }
};

/// The faces that a walk of some rings around a piece comes to.
Part walked_part(const Level& level, const Piece& piece, int rings) {
  const Topology& t = level.topology();
  if (piece.kind != Piece::Kind::corner) {
    const Index face = index(t.face(piece.start));
    return part(level, std::span(&face, 1), rings);
  }
  std::vector<Index> faces;  // it begins with those around the vertex
  for (const HalfEdge fan : t.fans(t.tail(piece.start))) {
    HalfEdge h = fan;
    do {
      faces.push_back(index(t.face(h)));
      h = t.ccw(h);
    } while (exists(h) && h != fan);
  }
  return part(level, faces, rings - 1);
}

/// Whether some rings around a piece decide all points in as many rings around its children: these have the same
/// weights if everything beyond is cut off.
bool decide_children(const Scheme<double>& scheme, const LabelledLevel& labelled, const Refined& whole,
                     const Piece& piece, int rings) {
  PieceWalker walker;
  const auto walk = [&](const Level& level, const Piece& p) {
    return walker.walk(level.topology(), level.sharpness, p, rings, 0);
  };
  std::vector<Index> points = walk(labelled.level, piece).vertices;
  std::sort(points.begin(), points.end());
  const Part around = walked_part(labelled.level, piece, rings);
  std::vector<Level> levels{around.level};
  for (int k = 0; k < scheme.period; ++k) levels.push_back(next_topology(scheme, levels.back(), [](const auto&...) {}));
  const std::vector<LevelStep> steps = steps_of(std::span(levels).subspan(1));
  const auto start = std::lower_bound(around.halves.begin(), around.halves.end(), index(piece.start));
  const Piece in_part{piece.kind, HalfEdge{static_cast<Index>(start - around.halves.begin())}};
  const std::vector<PieceChild> those = children(piece, labelled.level.topology(), whole.steps),
                                these = children(in_part, around.level.topology(), steps);
  if (those.size() != these.size()) return false;
  std::vector<PieceWalk> walks;
  std::vector<Index> rows;
  for (size_t c = 0; c < these.size(); ++c) {
    const PieceWalk& own = walks.emplace_back(walk(levels.back(), these[c].piece));
    if (own.signature != walk(labelled.period.back(), those[c].piece).signature) return false;
    rows.insert(rows.end(), own.vertices.begin(), own.vertices.end());
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  const SparseMatrix S = local_patch_detail::period_rows(scheme, levels, std::move(rows));
  const auto is_inside = [&](const auto& term) { return std::ranges::binary_search(points, term.first); };
  for (size_t c = 0; c < these.size(); ++c) {
    const std::vector<Index> vertices = walk(labelled.period.back(), those[c].piece).vertices;
    for (size_t s = 0; s < vertices.size(); ++s) {
      const MaskRow row = row_of(whole.S, vertices[s]);
      if (!std::ranges::all_of(row, is_inside)) return false;
      if (!has_same_weights(row, row_of(S, walks[c].vertices[s], &around.vertices))) return false;
    }
  }
  return true;
}

/// Returns `decide_children`, or false if a mask has no rule for the rim of the part.
bool are_enough(const Scheme<double>& scheme, const LabelledLevel& labelled, const Refined& whole, const Piece& piece,
                int rings) {
  try {
    return decide_children(scheme, labelled, whole, piece, rings);
  } catch (const Error&) {
    return false;
  }
}

std::vector<Piece> pieces_of(const Scheme<double>& scheme, const Topology& t, Face face) {
  std::vector<Piece> pieces;
  if (!scheme.is_dual()) return {{t.size(face) == 3 ? Piece::Kind::triangle : Piece::Kind::quad, t.first(face)}};
  for (Index k = 0; k < t.size(face); ++k) pieces.push_back({Piece::Kind::corner, t.corner(face, k)});
  return pieces;
}

}  // namespace

int piece_rings(const Scheme<double>& scheme) {
  if (has_narrow_masks(scheme) && scheme.period == 1) return 1;
  int rings = 1;
  for (const LabelledLevel& labelled : labelled_levels(scheme)) {
    const Refined whole(labelled.period);
    for (const Index face : labelled.faces)
      for (const Piece& piece : pieces_of(scheme, labelled.level.topology(), Face{face}))
        while (!are_enough(scheme, labelled, whole, piece, rings))
          if (++rings > most_rings)
            throw AnalysisError(scheme.name + ": masks reach beyond " + std::to_string(most_rings) + " rings of faces");
  }
  return rings;
}

}  // namespace sublimit
