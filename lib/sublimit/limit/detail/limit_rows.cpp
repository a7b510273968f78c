// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/detail/limit_rows.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/neighborhood/walk.h"
#include "sublimit/scheme/detail/refine_impl.h"
#include "sublimit/scheme/detail/subdivision_rows.h"

namespace sublimit {
namespace {

using Row = LimitRows::Row;

/// The masks of one side of a known type, on the mesh.
/// @param slots  of the masks' weights among `vertices`; empty: all of them, in order
LimitRows rows_of(const LimitMasks& masks, const LimitMasks::Side& side, std::span<const Index> slots,
                  const std::vector<Index>& vertices) {
  // Columns ascend: in what order weights come is the same for all masks.
  std::vector<std::pair<Index, Eigen::Index>> terms(static_cast<size_t>(masks.position.size()));
  for (size_t i = 0; i < terms.size(); ++i)
    terms[i] = {vertices[slots.empty() ? i : static_cast<size_t>(slots[i])], static_cast<Eigen::Index>(i)};
  std::sort(terms.begin(), terms.end());
  LimitRows result;
  result.plane = side.plane;
  result.rule = masks.rule;
  result.faces = side.num_corners;
  result.rows.reserve(3 + side.second_order.size(), (3 + side.second_order.size()) * terms.size());
  const auto add = [&](const LimitMasks::Mask& mask) {
    if (mask.size() > 0)
      for (const auto& [vertex, i] : terms)
        if (mask[i] != 0) result.rows.add(vertex, mask[i]);
    result.rows.end_row();
  };
  add(masks.position);
  add(side.tangent1);
  add(side.tangent2);
  for (const LimitMasks::Mask& mask : side.second_order) add(mask);
  return result;
}

/// The one-ring of the last vertex that was asked for: there may be hundreds of sides, which come one after another.
struct OneRing {
  Vertex vertex{-1};
  NeighborhoodAt at;
  const LimitMasks* masks = nullptr;
};

/// A vertex whose one-ring is all that its limit depends on, whatever is sharp there: the type is that of all its
/// sides.
LimitRows one_ring_rows(const Level& level, LimitCache& cache, HalfEdge corner, OneRing& ring) {
  const Topology& t = level.topology();
  if (ring.vertex != t.tail(corner)) {
    ring.at = neighborhood(t, level.sharpness, t.tail(corner));
    ring.masks = &cache.masks(ring.at.type);
    ring.vertex = t.tail(corner);
  }
  const NeighborhoodAt& at = ring.at;
  const LimitMasks& masks = *ring.masks;
  for (const LimitMasks::Side& side : masks.sides) {
    const std::vector<HalfEdge>& corners = at.corners[side.fan];
    for (Index c = 0; c < side.num_corners; ++c)
      if (corners[(side.first_corner + c) % corners.size()] == corner) return rows_of(masks, side, {}, at.vertices);
  }
  throw AnalysisError(cache.scheme().name + ": a corner is on no side of its vertex");
}

/// A centre that is alone among regular points, as far as its limit depends on them.
std::optional<LimitRows> isolated_rows(const Level& level, LimitCache& cache, const Centre& centre) {
  if (centre.kind == Centre::Kind::edge) return std::nullopt;  // a vertex or face, one level on
  // Of dual schemes a vertex becomes a face, or the middle of a border edge, whose masks tell more.
  if (centre.kind == Centre::Kind::vertex && cache.scheme().is_dual()) return std::nullopt;
  const LocalType type = local_type(level.topology(), level.sharpness, centre, level.number, cache.scheme().period);
  const IsolatedLimit* limit = cache.isolated(type);
  if (!limit) return std::nullopt;
  const Walk places = walk(level.topology(), level.sharpness, centre, limit->depth, &limit->signature);
  if (places.decays || places.signature != limit->signature) return std::nullopt;
  return rows_of(limit->masks, limit->masks.sides[0], limit->slots, places.vertices);
}

/// The corner of a piece that a centre is.
std::pair<Piece, int> piece_corner(const Scheme<double>& scheme, const Topology& t, const Centre& centre) {
  using Kind = Piece::Kind;
  switch (centre.kind) {
    case Centre::Kind::face:
      return {{Kind::corner, centre.start}, 2};
    case Centre::Kind::border:
    case Centre::Kind::edge:
      return {{Kind::corner, centre.start}, 1};
    case Centre::Kind::vertex:
      break;
  }
  const Kind of_polygon = scheme.is_dual() ? Kind::corner : Kind::cut;
  const Index size = t.size(t.face(centre.start));
  const bool whole = !scheme.is_dual() && size == (scheme.face_size() == 3 ? 3 : 4);
  return {{!whole ? of_polygon : size == 3 ? Kind::triangle : Kind::quad, centre.start}, 0};
}

/// Adds a row over the vertices of a piece, which is given in differences from the first.
/// @param own  weight of the first besides
void add_differences(const Eigen::RowVectorXd& differences, double own, const std::vector<Index>& vertices,
                     SparseRows& rows) {
  std::vector<SparseRows::Term> terms{{vertices[0], own - differences.sum()}};
  for (Eigen::Index i = 0; i < differences.size(); ++i) terms.push_back({vertices[size_t(i) + 1], differences[i]});
  std::sort(terms.begin(), terms.end());
  for (const auto& [vertex, weight] : terms)
    if (weight != 0) rows.add(vertex, weight);
  rows.end_row();
}

/// What is told of a centre besides its rows.
LimitRows without_rows(const Level& level, LimitCache& cache, const Centre& centre) {
  LimitRows result;
  const LocalType type = local_type(level.topology(), level.sharpness, centre, level.number, cache.scheme().period);
  const bool open = type.open || type.kind == Centre::Kind::border;
  result.rule = type.corner ? Rule::corner : open ? Rule::crease : Rule::smooth;
  result.faces = type.faces;
  return result;
}

/// The piece that has a centre as one of its corners.
struct CornerPiece {
  Piece::Kind kind;
  int corner;
  const PieceType* type;
  std::vector<Index> vertices;  ///< by slot
};
CornerPiece corner_piece(const Level& level, LimitCache& cache, const Centre& centre) {
  const auto [piece, corner] = piece_corner(cache.scheme(), level.topology(), centre);
  static thread_local PieceWalker walker;
  const PieceWalk& walk = walker.walk(level, piece, cache.pieces().rings(level.sharpness), cache.scheme().period);
  return {piece.kind, corner, cache.pieces().type(level, piece, walk), walk.vertices};
}

/// A centre that never is alone, but comes to repeat itself: two faces back to back under a dual scheme, for one. The
/// position is that of a corner of the piece there; what its tangents are is not known.
LimitRows repeating_rows(const Level& level, LimitCache& cache, const Centre& centre) {
  const CornerPiece piece = corner_piece(level, cache, centre);
  LimitRows result = without_rows(level, cache, centre);
  add_differences(piece.type->corner_limit(piece.corner), 1, piece.vertices, result.rows);
  result.plane = LimitMasks::Plane::no;
  return result;
}

/// A place whose knots are not those of equal intervals: by the polynomial that meets it.
std::optional<LimitRows> polynomial_rows(const Level& level, LimitCache& cache, const Centre& centre) {
  const bool is_dual = cache.scheme().is_dual();
  if (centre.kind != (is_dual ? Centre::Kind::face : Centre::Kind::vertex)) return std::nullopt;
  const CornerPiece piece = corner_piece(level, cache, centre);
  const bool of_polygon = piece.kind == Piece::Kind::cut;
  const PiecePolynomial* const polynomial = of_polygon ? nullptr : piece.type->polynomial();
  if (!polynomial) return std::nullopt;
  LimitRows result = without_rows(level, cache, centre);
  const double at = is_dual ? 1 : 0;
  const RowMatrix rows = polynomial->rows(quad_place(at, at), 1);
  for (int i = 0; i < 3; ++i) add_differences(rows.row(i), i == 0 ? 1 : 0, piece.vertices, result.rows);
  return result;
}

std::optional<LimitRows> known_rows(const Level& level, LimitCache& cache, const Centre& centre, OneRing& ring) {
  if (!level.intervals.empty()) return polynomial_rows(level, cache, centre);
  if (centre.kind == Centre::Kind::vertex && cache.scheme().has_one_ring_limits())
    return one_ring_rows(level, cache, centre.start, ring);
  return isolated_rows(level, cache, centre);
}

/// Whether a centre is one whose masks take long: those of many faces do. There are few of them in any mesh.
bool is_among_many(const Topology& t, const Centre& centre) {
  constexpr Index many = 32;
  if (centre.kind == Centre::Kind::face) return t.size(t.face(centre.start)) > many;
  return centre.kind == Centre::Kind::vertex && t.num_faces(t.tail(centre.start)) > many;
}

/// Finds what the limits of such centres need beforehand, one type a thread: those of a block are found one after the
/// other, and two that are alike wait for each other. What has no limit is met again, and named, where it is needed.
void find_large_types(const Level& level, LimitCache& cache, std::span<const Centre> centres) {
  const Topology& t = level.topology();
  if (!level.intervals.empty()) return;
  const auto for_each_of = [](const auto& types, const auto& find) {
    if (types.size() < 2) return;
    parallel_for_blocks(
        std::ssize(types),
        [&](std::int64_t i, std::int64_t, std::int64_t) {
          try {
            find(types[size_t(i)]);
          } catch (const AnalysisError&) {
          }
        },
        1);
  };
  if (!cache.scheme().has_one_ring_limits()) {
    std::set<LocalType> distinct;
    for (const Centre& centre : centres)
      if (is_among_many(t, centre) && !(centre.kind == Centre::Kind::vertex && cache.scheme().is_dual()))
        distinct.insert(local_type(t, level.sharpness, centre, level.number, cache.scheme().period));
    for_each_of(std::vector<LocalType>(distinct.begin(), distinct.end()),
                [&](const LocalType& type) { cache.isolated(type); });
    return;
  }
  std::set<Vertex> vertices;
  for (const Centre& centre : centres)
    if (centre.kind == Centre::Kind::vertex && is_among_many(t, centre)) vertices.insert(t.tail(centre.start));
  std::map<std::vector<std::uint32_t>, CanonicalNeighborhood> distinct;
  for (const Vertex v : vertices) {
    NeighborhoodAt at = neighborhood(t, level.sharpness, v);
    distinct.try_emplace(at.type.signature(), std::move(at.type));
  }
  std::vector<const CanonicalNeighborhood*> types;
  for (const auto& [signature, type] : distinct) types.push_back(&type);
  for_each_of(types, [&](const CanonicalNeighborhood* type) { cache.masks(*type); });
}

/// rows * S, with the columns of the result renamed.
/// @param name  of each column, ascending
/// @param sum   zeros, by column; again so afterwards
SparseRows pulled_back(const SparseRows& rows, const SparseMatrix& S, const std::vector<Index>& name,
                       std::vector<double>& sum) {
  SparseRows result;
  std::vector<Index> columns;
  sum.resize(static_cast<size_t>(S.cols()), 0);
  const auto add = [&](size_t column) {
    if (sum[column] != 0) result.add(name[column], sum[column]);
    sum[column] = 0;  // what came to nothing halfway is listed twice
  };
  for (size_t i = 0; i < rows.size(); ++i) {
    columns.clear();
    for (const auto& [r, weight] : rows[i])
      for (SparseMatrix::InnerIterator it(S, r); it; ++it) {
        double& to = sum[static_cast<size_t>(it.col())];
        if (to == 0) columns.push_back(static_cast<Index>(it.col()));
        to += weight * it.value();
      }
    if (columns.size() * 16 > sum.size()) {  // around a vertex of many faces: sorting would cost more
      for (size_t column = 0; column < sum.size(); ++column) add(column);
    } else {
      std::sort(columns.begin(), columns.end());
      for (const Index column : columns) add(static_cast<size_t>(column));
    }
    result.end_row();
  }
  return result;
}

/// Which faces are cut before the first level depends on all of them.
bool is_prepared_first(const Scheme<double>& scheme, const Level& level) {
  return level.number == 0 && !scheme.preparation.empty() && level.topology().uniform_face_size() != scheme.corners;
}

/// @param why  for each place what keeps it from having a limit; empty if it has one
std::vector<LimitRows> found_rows(const Level& level, LimitCache& cache, std::span<const Centre> centres, int depth,
                                  std::vector<std::string>& why) {
  const Scheme<double>& scheme = cache.scheme();
  const auto count = static_cast<std::int64_t>(centres.size());
  std::vector<LimitRows> rows(centres.size());
  std::vector<std::uint8_t> done(centres.size(), 0);
  const bool whole = is_prepared_first(scheme, level);
  if (!whole) find_large_types(level, cache, centres);
  if (!whole)
    parallel_for_blocks(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      OneRing ring;
      for (std::int64_t i = begin; i < end; ++i) {
        try {
          std::optional<LimitRows> known = known_rows(level, cache, centres[i], ring);
          if (!known && depth == 0) known = repeating_rows(level, cache, centres[i]);
          if (!known) continue;
          rows[i] = std::move(*known);
        } catch (const AnalysisError& error) {
          why[i] = error.what();
        }
        done[i] = 1;
      }
    });
  std::vector<size_t> rest;
  for (size_t i = 0; i < centres.size(); ++i)
    if (!done[i]) rest.push_back(i);
  if (rest.empty()) return rows;

  Part around;
  if (!whole) {
    std::vector<Index> faces;
    for (const size_t i : rest) faces.push_back(index(level.topology().face(centres[i].start)));
    around = part(level, faces, cache.pieces().rings_around_corner(level));
  } else {
    around.vertices.resize(level.topology().num_vertices());
    std::iota(around.vertices.begin(), around.vertices.end(), 0);
  }
  const Level& parent = whole ? level : around.level;
  // Of one step only few rows will be asked for.
  const bool few = !whole && scheme.steps.size() == 1;
  const Level child_level = few ? next_topology(scheme, parent, [](const auto&...) {}) : next_level(scheme, parent);
  std::vector<size_t> followed;
  std::vector<Centre> children;
  for (const size_t i : rest) {
    Centre centre = centres[i];
    if (!whole) {
      const auto at = std::lower_bound(around.halves.begin(), around.halves.end(), index(centre.start));
      centre.start = HalfEdge{static_cast<Index>(at - around.halves.begin())};
    }
    try {
      const Topology* before = &parent.topology();
      for (const Refinement& step : child_level.steps) {
        centre = child(centre, *before, step, level.number);
        before = &step.topology;
      }
      children.push_back(centre);
      followed.push_back(i);
    } catch (const AnalysisError& error) {
      why[i] = error.what();
    }
  }
  std::vector<std::string> why_not(children.size());
  std::vector<LimitRows> fine = found_rows(child_level, cache, children, depth - 1, why_not);
  std::vector<Index> used;
  for (const LimitRows& limit : fine)
    for (size_t i = 0; i < limit.rows.size(); ++i)
      for (const auto& term : limit.rows[i]) used.push_back(term.first);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  const SparseMatrix S = few ? subdivision_rows(scheme, parent, child_level, used) : child_level.S;
  parallel_for_blocks(static_cast<std::int64_t>(followed.size()),
                      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                        std::vector<double> sum;
                        for (std::int64_t i = begin; i < end; ++i) {
                          fine[i].rows = pulled_back(fine[i].rows, S, around.vertices, sum);
                          rows[followed[i]] = std::move(fine[i]);
                          why[followed[i]] = std::move(why_not[i]);
                        }
                      });
  return rows;
}

}  // namespace

namespace {

/// Whether control points move in one direction by all of `rows`, but for what goes along the tangents.
bool is_one_direction(const LimitRows& limit) {
  std::map<Index, Eigen::Index> columns;
  for (size_t i = 1; i < limit.rows.size(); ++i)
    for (const auto& term : limit.rows[i]) columns.try_emplace(term.first, Eigen::Index(columns.size()));
  const auto dense = [&](Row row) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(Eigen::Index(columns.size()));
    for (const auto& [column, weight] : row) all[columns.at(column)] += weight;
    return all;
  };
  Eigen::MatrixXd plane(Eigen::Index(columns.size()), 2);
  plane << dense(limit.tangent1()), dense(limit.tangent2());
  const double inwards = plane.col(1).norm();
  if (!(inwards > 0)) return false;
  const PivotedQr qr(plane);
  if (qr.rank() < 2) return false;
  constexpr double rounding = 1e-10;  // of eigenvectors that a period or two carry back
  for (size_t k = 0; k < limit.num_second_order(); ++k) {
    Eigen::VectorXd way = dense(limit.second_order(k));
    const Eigen::Vector2d parts = qr.solve(way);
    way.noalias() -= plane * parts;
    if (!(way.norm() <= rounding * inwards && parts[1] >= -rounding)) return false;
  }
  return true;
}

LimitStatus status_of(const LimitRows& rows, const Scheme<double>& scheme) {
  // Along a smooth crease of a single mesh edge the normal has a limit even where the normals inside have another.
  const bool along_crease = rows.rule == Rule::crease && scheme.has_one_ring_limits() && !rows.tangent1().empty();
  const bool has_plane = along_crease || (rows.plane == LimitMasks::Plane::tied ? is_one_direction(rows)
                                                                                : rows.plane != LimitMasks::Plane::no);
  if (!has_plane) return LimitStatus::undefined_normal;
  if (rows.rule == Rule::crease || rows.rule == Rule::corner) return LimitStatus::crease;
  return rows.rule == Rule::smooth && rows.faces == scheme.regular_valence() ? LimitStatus::regular
                                                                             : LimitStatus::extraordinary;
}

}  // namespace

std::vector<LimitRows> limit_rows(const Level& level, LimitCache& cache, std::span<const Centre> centres) {
  cache.check(level);
  std::vector<std::string> why(centres.size());
  // Pieces are known of levels where a period begins.
  const int period = cache.scheme().period, depth = 12 + (period - level.number % period) % period;
  std::vector<LimitRows> rows = found_rows(level, cache, centres, depth, why);
  const auto failed = std::ranges::find_if(why, [](const std::string& reason) { return !reason.empty(); });
  if (failed == why.end()) {
    parallel_for(std::ssize(rows), [&](std::int64_t i) { rows[i].status = status_of(rows[i], cache.scheme()); });
    return rows;
  }
  const Centre& centre = centres[failed - why.begin()];
  const Topology& t = level.topology();
  const std::string of_level = level.number == 0 ? "" : " of level " + std::to_string(level.number);
  if (centre.kind == Centre::Kind::face)
    throw NoLimit("the middle of face " + std::to_string(index(t.face(centre.start))) + of_level, *failed);
  throw NoLimit(index(t.tail(centre.start)), level.number, *failed);
}

LimitRows limit_rows(const Level& level, LimitCache& cache, const Centre& centre) {
  return std::move(limit_rows(level, cache, std::span(&centre, 1))[0]);
}

}  // namespace sublimit
