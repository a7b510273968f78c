// SPDX-License-Identifier: Apache-2.0
// Grids: the same places on all squares or triangles. Points on sides belong to several of them, and get the same bits.
#include <algorithm>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/limit/limit_surface_parts.h"

namespace sublimit {

namespace {

constexpr std::int64_t nobody = -1;

/// Calls share(row, key) for every sample on a side: equal keys, equal points, but for `nobody`. Keys count vertices,
/// then places on edges in steps of half a sample (squares of polygons have half an edge each), then places between the
/// squares of a polygon. Dual schemes have a border on each side of a non-manifold edge, and a corner for each fan of a
/// vertex.
template <class Share>
void for_each_shared_place(const Topology& t, const Addresses& addresses, int N, bool dual, const Share& share) {
  const std::int64_t steps = 2 * std::int64_t(N - 1);
  const std::int64_t first_inside = t.num_vertices() + std::int64_t(t.num_edges()) * (steps - 1),
                     first_apart = first_inside + std::int64_t(t.num_half_edges()) * N;
  const auto at_tail = [&](HalfEdge h) -> std::int64_t {
    if (!dual || !t.is_nonmanifold(t.tail(h))) return index(t.tail(h));
    HalfEdge least = h;  // of the fan: its first one if it is open
    for (HalfEdge g = h; exists(t.twin(g));) {
      g = t.next(t.twin(g));
      if (g == h) break;
      if (!exists(t.twin(g)) || index(g) < index(least)) least = g;
    }
    return first_apart + index(least);
  };
  const auto on_edge = [&](HalfEdge h, std::int64_t from_tail) -> std::int64_t {
    if (from_tail == 0) return at_tail(h);
    if (from_tail == steps) return at_tail(t.next(h));
    if (dual && !exists(t.twin(h)))  // two squares of one polygon share its middle
      return from_tail == N - 1 ? first_apart + t.num_half_edges() + index(h) : nobody;
    return t.num_vertices() + index(t.edge(h)) * (steps - 1) + (t.forward(h) ? from_tail : steps - from_tail) - 1;
  };
  // From the middle of an edge (0 is on the edge) to the middle of the face.
  const auto on_spoke = [&](HalfEdge h, std::int64_t k) -> std::int64_t {
    if (k == 0) return on_edge(h, N - 1);
    if (k == N - 1) h = t.first(t.face(h));  // the middle is one
    return first_inside + index(h) * std::int64_t(N) + k;
  };
  std::int64_t row = 0;
  for (Index a = 0; a < addresses.size(); ++a) {
    const Addresses::Place at = addresses.place(a);
    const bool triangle = addresses.triangles();
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < (triangle ? N - j : N); ++i, ++row) {
        const int k = N - 1 - i - j;  // triangles: steps from the third side
        if (at.corner >= 0) {
          const HalfEdge h = t.corner(at.face, at.corner), before = t.prev(h);
          if (j == 0)
            share(row, on_edge(h, i));
          else if (i == 0)
            share(row, on_edge(before, steps - j));
          else if (i == N - 1)
            share(row, on_spoke(h, j));
          else if (j == N - 1)
            share(row, on_spoke(before, i));
          continue;
        }
        const HalfEdge h = t.first(at.face);
        if (j == 0)
          share(row, on_edge(h, 2 * i));
        else if (triangle && k == 0)
          share(row, on_edge(t.next(h), 2 * j));
        else if (!triangle && i == N - 1)
          share(row, on_edge(t.next(h), 2 * j));
        else if (!triangle && j == N - 1)
          share(row, on_edge(t.next(t.next(h)), 2 * (N - 1 - i)));
        else if (i == 0)
          share(row, on_edge(t.prev(h), 2 * (N - 1 - j)));
      }
  }
}

}  // namespace

std::vector<std::pair<std::int64_t, std::int64_t>> shared_grid_places(const Topology& t, const Addresses& addresses,
                                                                      int N, bool dual) {
  const bool has_spokes = t.uniform_face_size() != (addresses.triangles() ? 3 : 4);
  const std::int64_t keys = t.num_vertices() + std::int64_t(t.num_edges()) * (2 * std::int64_t(N - 1) - 1) +
                            std::int64_t(t.num_half_edges()) * ((has_spokes || dual ? N : 0) + (dual ? 2 : 0));
  std::vector<std::int64_t> owner(keys, -1);
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
  for_each_shared_place(t, addresses, N, dual, [&](std::int64_t row, std::int64_t key) {
    if (key == nobody) return;
    std::int64_t& first = owner[key];
    if (first < 0)
      first = row;
    else
      pairs.push_back({row, first});
  });
  return pairs;
}

LimitSamples LimitSurface::evaluate_grid(const Points& points, int N, int order, bool normals) const {
  const std::vector<Sample> samples = grid(N);
  LimitSamples result = evaluate(points, samples, order, normals);
  for (const auto& [row, first] :
       shared_grid_places(parts_->level.topology(), parts_->addresses, N, parts_->types->pieces().scheme().is_dual()))
    result.position.row(row) = result.position.row(first);
  return result;
}

}  // namespace sublimit
