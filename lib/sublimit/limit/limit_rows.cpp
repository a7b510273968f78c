// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/limit_rows.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/core/dense_decompositions.h"
#include "sublimit/core/sparse_product.h"
#include "sublimit/limit/stationary_rows.h"
#include "sublimit/neighborhood/walk.h"
#include "sublimit/scheme/refine_impl.h"
#include "sublimit/scheme/subdivision_rows.h"

namespace sublimit {
namespace {

using Row = LimitRows::Row;

/// A mask on the mesh.
/// @param slots  of the mask's weights among `vertices`; empty: all of them, in order
Row gathered(const LimitMasks::Mask& mask, const std::vector<Index>& slots, const std::vector<Index>& vertices) {
  Row row;
  row.reserve(size_t(mask.size()));
  for (Eigen::Index i = 0; i < mask.size(); ++i)
    if (mask[i] != 0) row.push_back({vertices[slots.empty() ? size_t(i) : size_t(slots[size_t(i)])], mask[i]});
  std::sort(row.begin(), row.end());
  size_t kept = 0;  // slots of one vertex add up
  for (size_t i = 1; i < row.size(); ++i) {
    if (row[i].first == row[kept].first)
      row[kept].second += row[i].second;
    else
      row[++kept] = row[i];
  }
  row.resize(std::min(row.size(), kept + 1));
  return row;
}

/// Rows of one side of a known type.
LimitRows rows_of(const LimitMasks& masks, const LimitMasks::Side& side, const auto& gathered_row) {
  LimitRows rows;
  rows.position = gathered_row(masks.position);
  rows.tangent1 = gathered_row(side.tangent1);
  rows.tangent2 = gathered_row(side.tangent2);
  for (const LimitMasks::Mask& mask : side.second_order) rows.second_order.push_back(gathered_row(mask));
  rows.plane = side.plane;
  rows.rule = masks.rule;
  rows.faces = side.num_corners;
  return rows;
}

/// A vertex whose one-ring is all that its limit depends on, whatever is sharp there: the type is that of all its sides.
LimitRows one_ring_rows(const Level& level, LimitTypes& cache, HalfEdge corner) {
  const Topology& t = level.topology();
  const NeighborhoodAt at = neighborhood(t, level.sharpness, t.tail(corner));
  const LimitMasks& masks = cache.masks(at.type);
  for (const LimitMasks::Side& side : masks.sides) {
    const std::vector<HalfEdge>& corners = at.corners[side.fan];
    for (Index c = 0; c < side.num_corners; ++c)
      if (corners[(side.first_corner + c) % corners.size()] == corner)
        return rows_of(masks, side, [&](const LimitMasks::Mask& mask) { return gathered(mask, {}, at.vertices); });
  }
  throw AnalysisError(cache.scheme().name + ": a corner is on no side of its vertex");
}

/// A centre that is alone among regular points, as far as its limit depends on them.
std::optional<LimitRows> lone_rows(const Level& level, LimitTypes& cache, const Centre& centre) {
  if (centre.kind == Centre::Kind::edge) return std::nullopt;  // a vertex or face, one level on
  // Of dual schemes a vertex becomes a face, or the middle of a border edge, whose masks tell more.
  if (centre.kind == Centre::Kind::vertex && cache.scheme().is_dual()) return std::nullopt;
  const LocalType type = local_type(level.topology(), level.sharpness, centre, level.number, cache.scheme().period);
  const LoneLimit* limit = cache.lone(type);
  if (!limit) return std::nullopt;
  const Walk places = walk(level.topology(), level.sharpness, centre, limit->depth);
  if (places.decays || places.signature != limit->signature) return std::nullopt;
  return rows_of(limit->masks, limit->masks.sides[0],
                 [&](const LimitMasks::Mask& mask) { return gathered(mask, limit->slots, places.vertices); });
}

std::optional<LimitRows> known_rows(const Level& level, LimitTypes& cache, const Centre& centre) {
  if (centre.kind == Centre::Kind::vertex && cache.scheme().has_one_ring_limits())
    return one_ring_rows(level, cache, centre.start);
  return lone_rows(level, cache, centre);
}

/// row * S, with the columns of the result renamed.
Row pulled_back(const Row& row, const SparseMatrix& S, const std::vector<Index>& name) {
  std::map<Index, double> sum;
  for (const auto& [r, weight] : row)
    for (SparseMatrix::InnerIterator it(S, r); it; ++it) sum[name[it.col()]] += weight * it.value();
  Row result;
  for (const auto& [column, weight] : sum)
    if (weight != 0) result.push_back({column, weight});
  return result;
}

void for_each(LimitRows& rows, const auto& what) {
  for (Row* row : {&rows.position, &rows.tangent1, &rows.tangent2}) what(*row);
  for (Row& row : rows.second_order) what(row);
}

/// Rings of faces around the places that the next level's limits may depend on.
int rings_needed(const Scheme<double>& scheme) { return scheme.has_one_ring_limits() ? 1 : 5; }

/// Which faces are cut before the first level depends on all of them.
bool is_prepared_first(const Scheme<double>& scheme, const Level& level) {
  return level.number == 0 && !scheme.preparation.empty() && level.topology().uniform_face_size() != scheme.corners;
}

/// @param why  for each place what keeps it from having a limit; empty if it has one
std::vector<LimitRows> found_rows(const Level& level, LimitTypes& cache, const std::vector<Centre>& centres, int depth,
                               std::vector<std::string>& why) {
  const Scheme<double>& scheme = cache.scheme();
  const auto count = static_cast<std::int64_t>(centres.size());
  std::vector<LimitRows> rows(centres.size());
  std::vector<std::uint8_t> done(centres.size(), 0);
  const bool whole = is_prepared_first(scheme, level);
  const auto try_each = [&](const auto& rows_at) {
    parallel_for(count, [&](std::int64_t i) {
      if (done[i]) return;
      try {
        if (std::optional<LimitRows> known = rows_at(centres[i])) {
          rows[i] = std::move(*known);
          done[i] = 1;
        }
      } catch (const AnalysisError& error) {
        why[i] = error.what();
        done[i] = 1;
      }
    });
  };
  if (!whole) try_each([&](const Centre& centre) { return known_rows(level, cache, centre); });
  if (depth == 0) try_each([&](const Centre& centre) { return stationary_rows(level, scheme, centre); });
  std::vector<size_t> rest;
  for (size_t i = 0; i < centres.size(); ++i)
    if (!done[i]) rest.push_back(i);
  if (depth == 0)
    for (const size_t i : rest) why[i] = "its neighbourhood stays irregular under refinement";
  if (rest.empty() || depth == 0) return rows;

  Part around;
  if (!whole) {
    std::vector<Index> faces;
    for (const size_t i : rest) faces.push_back(index(level.topology().face(centres[i].start)));
    around = part(level, faces, rings_needed(scheme));
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
  for (LimitRows& row : fine)
    for_each(row, [&](const Row& r) {
      for (const auto& term : r) used.push_back(term.first);
    });
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  const SparseMatrix S = few ? subdivision_rows(scheme, parent, child_level, used) : child_level.S;
  parallel_for(static_cast<std::int64_t>(followed.size()), [&](std::int64_t i) {
    LimitRows& row = fine[i];
    for_each(row, [&](Row& r) { r = pulled_back(r, S, around.vertices); });
    rows[followed[i]] = std::move(row);
    why[followed[i]] = std::move(why_not[i]);
  });
  return rows;
}

}  // namespace

namespace {

/// Whether control points move in one direction by all of `rows`, but for what goes along the tangents.
bool is_one_direction(const LimitRows& limit) {
  std::map<Index, Eigen::Index> columns;
  for (const Row* row : {&limit.tangent1, &limit.tangent2})
    for (const auto& term : *row) columns.try_emplace(term.first, Eigen::Index(columns.size()));
  for (const Row& row : limit.second_order)
    for (const auto& term : row) columns.try_emplace(term.first, Eigen::Index(columns.size()));
  const auto dense = [&](const Row& row) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(Eigen::Index(columns.size()));
    for (const auto& [column, weight] : row) all[columns.at(column)] += weight;
    return all;
  };
  Eigen::MatrixXd plane(Eigen::Index(columns.size()), 2);
  plane << dense(limit.tangent1), dense(limit.tangent2);
  const double inwards = plane.col(1).norm();
  if (!(inwards > 0)) return false;
  const PivotedQr qr(plane);
  if (qr.rank() < 2) return false;
  constexpr double rounding = 1e-10;  // of eigenvectors that a period or two carry back
  return std::ranges::all_of(limit.second_order, [&](const Row& row) {
    Eigen::VectorXd way = dense(row);
    const Eigen::Vector2d parts = qr.solve(way);
    way.noalias() -= plane * parts;
    return way.norm() <= rounding * inwards && parts[1] >= -rounding;
  });
}

LimitStatus status_of(const LimitRows& rows, const Scheme<double>& scheme) {
  // Along a smooth crease of a single mesh edge the normal has a limit even where the normals inside have another.
  const bool along_crease = rows.rule == Rule::crease && scheme.has_one_ring_limits() && !rows.tangent1.empty();
  const bool has_plane =
      along_crease || (rows.plane == LimitMasks::Plane::tied ? is_one_direction(rows) : rows.plane != LimitMasks::Plane::no);
  if (!has_plane) return LimitStatus::undefined_normal;
  if (rows.rule == Rule::crease || rows.rule == Rule::corner) return LimitStatus::crease;
  return rows.rule == Rule::smooth && rows.faces == scheme.regular_valence() ? LimitStatus::regular
                                                                             : LimitStatus::extraordinary;
}

}  // namespace

std::vector<LimitRows> limit_rows(const Level& level, LimitTypes& cache, const std::vector<Centre>& centres) {
  std::vector<std::string> why(centres.size());
  std::vector<LimitRows> rows = found_rows(level, cache, centres, 12, why);
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

SparseMatrix matrix_of(std::span<const Row* const> rows, Index columns) {
  std::int64_t nonzeros = 0;
  for (const Row* row : rows) nonzeros += std::ssize(*row);
  if (nonzeros > std::numeric_limits<Index>::max())
    throw ResourceError("limit rows: more nonzeros than 32-bit indices count");
  SparseMatrix M(std::ssize(rows), columns);
  resize_nonzeros(M, nonzeros);
  M.outerIndexPtr()[0] = 0;
  for (size_t r = 0; r < rows.size(); ++r) M.outerIndexPtr()[r + 1] = M.outerIndexPtr()[r] + Index(rows[r]->size());
  parallel_for(std::ssize(rows), [&](std::int64_t r) {
    Index at = M.outerIndexPtr()[r];
    for (const auto& [column, weight] : *rows[size_t(r)]) {
      M.innerIndexPtr()[at] = column;
      M.valuePtr()[at++] = weight;
    }
  });
  return M;
}

}  // namespace sublimit
