// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/vertex_limits.h"

#include <algorithm>
#include <numeric>

#include "sublimit/limit/detail/limit_rows.h"
#include "sublimit/neighborhood/vertex_sides.h"

namespace sublimit {
namespace {

/// Number of each vertex in the list, -1 for the others.
std::vector<Index> numbers(std::span<const Index> vertices, Index num_vertices) {
  std::vector<Index> number(num_vertices, -1);
  for (size_t i = 0; i < vertices.size(); ++i) number[vertices[i]] = static_cast<Index>(i);
  return number;
}

}  // namespace

Centre descendant(Centre centre, std::span<const Level> levels) {
  for (size_t k = 1; k < levels.size(); ++k) {
    const Topology* before = &levels[k - 1].topology();
    for (const Refinement& step : levels[k].steps) {
      centre = child(centre, *before, step, levels[k - 1].number);
      before = &step.topology;
    }
  }
  return centre;
}

VertexLimits vertex_limits(std::span<const Level> levels, LimitCache& cache, std::span<const Index> vertices) {
  const Level& level = levels.back();
  const VertexSides sides = vertex_sides(levels.front());
  const std::vector<Index> number = numbers(vertices, levels.front().topology().num_vertices());
  VertexLimits result;
  std::vector<Centre> centres;
  std::vector<size_t> chosen;
  std::vector<Index> number_of;
  for (size_t s = 0; s < sides.centres.size(); ++s) {
    if (number[sides.vertex[s]] < 0) continue;
    centres.push_back(descendant(sides.centres[s], levels));
    chosen.push_back(s);
    number_of.push_back(number[sides.vertex[s]]);
  }
  const std::vector<LimitRows> rows = limit_rows(level, cache, centres);
  // The sides of a vertex, in the order of the list.
  std::vector<size_t> order(rows.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return number_of[a] < number_of[b]; });
  const bool dual = cache.scheme().is_dual();
  std::vector<LimitRows::Row> position, tangent1, tangent2;
  for (const size_t s : order) {
    const Index i = number_of[s];
    result.side_vertex.push_back(i);
    if (dual || result.position_vertex.empty() || result.position_vertex.back() != i) {
      position.push_back(rows[s].position());
      result.position_vertex.push_back(i);
    }
    tangent1.push_back(rows[s].tangent1());
    tangent2.push_back(rows[s].tangent2());
    result.status.push_back(sides.hole[chosen[s]] ? LimitStatus::hole : rows[s].status);
  }
  const Index columns = level.topology().num_vertices();
  result.position = matrix_of(position, columns);
  result.tangent1 = matrix_of(tangent1, columns);
  result.tangent2 = matrix_of(tangent2, columns);
  return result;
}

}  // namespace sublimit
