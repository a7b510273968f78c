// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/corner_limits.h"

#include <algorithm>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Row = LimitRows::Row;

Row gathered(const LimitMasks::Mask& mask, const std::vector<Index>& vertices) {
  Row row;
  for (size_t i = 0; i < vertices.size(); ++i)
    if (mask[Eigen::Index(i)] != 0) row.push_back({vertices[i], mask[Eigen::Index(i)]});
  std::sort(row.begin(), row.end());
  return row;
}

Row pulled_back(const Row& row, const SparseMatrix& S, const std::vector<Index>& name) {
  std::map<Index, double> sum;
  for (const auto& [r, weight] : row)
    for (SparseMatrix::InnerIterator it(S, r); it; ++it) sum[name[it.col()]] += weight * it.value();
  return Row(sum.begin(), sum.end());
}

}  // namespace

const CornerLimit* CornerLimits::at(const Centre& centre) const {
  const std::pair key{int(centre.kind), index(centre.start)};
  {
    const std::lock_guard lock(mutex_);
    if (const auto at = known_.find(key); at != known_.end()) return at->second ? &*at->second : nullptr;
  }
  std::optional<CornerLimit> limit;
  try {
    limit = computed(centre);
  } catch (const AnalysisError&) {
    // No tangents here; the position is known by the piece.
  }
  const std::lock_guard lock(mutex_);
  const auto& entry = known_.try_emplace(key, std::move(limit)).first->second;
  return entry ? &*entry : nullptr;
}

std::optional<CornerLimit> CornerLimits::of_vertex(const Level& level, HalfEdge corner) const {
  const Topology& t = level.topology();
  const NeighborhoodAt at = neighborhood(t, level.sharpness, t.tail(corner));
  const LimitMasks& masks = masks_.masks(at.type);
  for (const LimitMasks::Side& side : masks.sides)
    for (Index c = 0; c < side.num_corners; ++c) {
      const std::vector<HalfEdge>& corners = at.corners[side.fan];
      if (corners[(side.first_corner + c) % corners.size()] != corner) continue;
      CornerLimit limit;
      limit.rows.position = gathered(masks.position, at.vertices);
      limit.rows.tangent1 = gathered(side.tangent1, at.vertices);
      limit.rows.tangent2 = gathered(side.tangent2, at.vertices);
      for (const LimitMasks::Mask& mask : side.second_order)
        limit.rows.second_order.push_back(gathered(mask, at.vertices));
      limit.rows.plane = side.plane;
      limit.status = generic_status(masks, side, masks_.scheme());
      return limit;
    }
  return std::nullopt;
}

std::optional<CornerLimit> CornerLimits::computed(const Centre& centre) const {
  const Topology& t = level_.topology();
  if (has_one_ring_limits(masks_.scheme())) {
    if (centre.kind == Centre::Kind::vertex) return of_vertex(level_, centre.start);
    const Index face = index(t.face(centre.start));
    const Part around = part(level_, std::span(&face, 1), 1);
    const Level fine = next_level(masks_.scheme(), around.level);
    const auto own = std::lower_bound(around.faces.begin(), around.faces.end(), face) - around.faces.begin();
    const Vertex middle = fine.steps[0].child(Face{static_cast<Index>(own)});
    std::optional<CornerLimit> limit = of_vertex(fine, fine.topology().outgoing(middle));
    if (!limit) return limit;
    for (Row* row : {&limit->rows.position, &limit->rows.tangent1, &limit->rows.tangent2})
      *row = pulled_back(*row, fine.S, around.vertices);
    for (Row& row : limit->rows.second_order) row = pulled_back(row, fine.S, around.vertices);
    return limit;
  }
  Centre at = centre;
  if (at.kind == Centre::Kind::vertex) {
    const auto is_cut = [&](HalfEdge h) {
      return !exists(t.twin(h)) || is_sharp(level_.sharpness.edge[index(t.edge(h))]);
    };
    HalfEdge h = at.start;
    while (!is_cut(h)) {
      h = t.next(t.twin(h));
      if (h == at.start) break;
    }
    at.start = h;
  }
  CornerLimit limit;
  limit.rows = limit_rows(level_, masks_, {at})[0];
  limit.status = generic_status(limit.rows, masks_.scheme());
  return limit;
}

}  // namespace sublimit
