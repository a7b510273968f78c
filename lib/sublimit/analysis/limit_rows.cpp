// SPDX-License-Identifier: Apache-2.0
#include "sublimit/analysis/limit_rows.h"

#include <algorithm>
#include <map>
#include <string>

#include "sublimit/analysis/walk.h"
#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"

namespace sublimit {
namespace {

using Row = LimitRows::Row;

Row gathered(const LimitMasks::Mask& mask, const std::vector<Index>& slots, const std::vector<Index>& vertices) {
  Row row;
  for (size_t i = 0; i < slots.size(); ++i)
    if (mask[Eigen::Index(i)] != 0) row.push_back({vertices[slots[i]], mask[Eigen::Index(i)]});
  std::sort(row.begin(), row.end());
  return row;
}

std::optional<LimitRows> lone_rows(const Level& level, LimitMaskCache& cache, const Centre& centre) {
  const LocalType type =
      local_type(level.topology(), level.sharpness, centre, level.number, cache.scheme().period);
  const LoneLimit* limit = cache.lone(type);
  if (!limit) return std::nullopt;
  const Walk places = walk(level.topology(), level.sharpness, centre, limit->depth);
  if (places.signature != limit->signature) return std::nullopt;
  const LimitMasks::Side& side = limit->masks.sides[0];
  LimitRows rows;
  rows.position = gathered(limit->masks.position, limit->slots, places.vertices);
  rows.tangent1 = gathered(side.tangent1, limit->slots, places.vertices);
  rows.tangent2 = gathered(side.tangent2, limit->slots, places.vertices);
  for (const LimitMasks::Mask& mask : side.second_order)
    rows.second_order.push_back(gathered(mask, limit->slots, places.vertices));
  rows.plane = side.plane;
  rows.type = type;
  return rows;
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

/// Rings of faces around the places that the next level's limits may depend on.
constexpr int rings_needed = 5;

std::vector<LimitRows> rows_of(const Level& level, LimitMaskCache& cache, const std::vector<Centre>& centres, int depth) {
  std::vector<LimitRows> rows(centres.size());
  std::vector<std::uint8_t> alone(centres.size(), 0);
  parallel_for(static_cast<std::int64_t>(centres.size()), [&](std::int64_t i) {
    if (std::optional<LimitRows> known = lone_rows(level, cache, centres[i])) {
      rows[i] = std::move(*known);
      alone[i] = 1;
    }
  });
  std::vector<size_t> rest;
  for (size_t i = 0; i < centres.size(); ++i)
    if (!alone[i]) rest.push_back(i);
  if (rest.empty()) return rows;
  const Topology& t = level.topology();
  if (depth == 0)
    throw AnalysisError(cache.scheme().name + ": no limit at vertex " + std::to_string(index(t.tail(centres[rest[0]].start))) +
                        " of level " + std::to_string(level.number) +
                        ", whose neighbourhood stays irregular under refinement");

  std::vector<Index> faces;
  for (const size_t i : rest) faces.push_back(index(t.face(centres[i].start)));
  const Part around = part(level, faces, rings_needed);
  const Level child_level = next_level(cache.scheme(), around.level);
  std::vector<Centre> children;
  for (const size_t i : rest) {
    Centre centre = centres[i];
    const auto at = std::lower_bound(around.halves.begin(), around.halves.end(), index(centre.start));
    centre.start = HalfEdge{static_cast<Index>(at - around.halves.begin())};
    const Topology* before = &around.level.topology();
    for (const Refinement& step : child_level.steps) {
      centre = child(centre, *before, step, level.number);
      before = &step.topology;
    }
    children.push_back(centre);
  }
  std::vector<LimitRows> fine = rows_of(child_level, cache, children, depth - 1);
  parallel_for(static_cast<std::int64_t>(rest.size()), [&](std::int64_t i) {
    LimitRows& row = fine[i];
    for (Row* r : {&row.position, &row.tangent1, &row.tangent2}) *r = pulled_back(*r, child_level.S, around.vertices);
    for (Row& r : row.second_order) r = pulled_back(r, child_level.S, around.vertices);
    rows[rest[i]] = std::move(row);
  });
  return rows;
}

}  // namespace

LimitStatus generic_status(const LimitRows& rows, const Scheme<double>& scheme) {
  if (rows.plane == LimitMasks::Plane::no) return LimitStatus::undefined_normal;
  if (rows.type.open || rows.type.kind == Centre::Kind::border) return LimitStatus::crease;
  return rows.type.faces == (scheme.face_size() == 3 ? 6 : 4) ? LimitStatus::regular : LimitStatus::extraordinary;
}

std::vector<LimitRows> limit_rows(const Level& level, LimitMaskCache& cache, const std::vector<Centre>& centres) {
  return rows_of(level, cache, centres, 12);
}

}  // namespace sublimit
