// SPDX-License-Identifier: Apache-2.0
// Grids: the same places on all squares or triangles. Points on sides belong to several of them, and get the same bits.
#include "sublimit/surface/detail/limit_map_parts.h"
#include "sublimit/surface/detail/shared_places.h"

namespace sublimit {

std::vector<std::pair<std::int64_t, std::int64_t>> shared_grid_places(const Topology& t, const Addresses& addresses,
                                                                      int N, bool dual) {
  const SharedPlaces shared(t, addresses, N - 1, dual);
  std::vector<std::int64_t> owner(size_t(shared.size()), -1);
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
  std::int64_t row = 0;
  for (Index a = 0; a < addresses.size(); ++a)
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < (addresses.triangles() ? N - j : N); ++i, ++row) {
        const std::int64_t number = shared.number(a, i, j);
        if (number == SharedPlaces::not_shared) continue;
        std::int64_t& first = owner[size_t(number)];
        if (first < 0)
          first = row;
        else
          pairs.push_back({row, first});
      }
  return pairs;
}

LimitSamples LimitMap::evaluate_grid(const Points& points, int N, int order, bool normals) const {
  const std::vector<Place> samples = grid(N);
  LimitSamples result = evaluate(points, samples, order, normals);
  for (const auto& [row, first] :
       shared_grid_places(parts_->level.topology(), parts_->addresses, N, parts_->types->pieces().scheme().is_dual()))
    result.position.row(row) = result.position.row(first);
  return result;
}

}  // namespace sublimit
