// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits under sqrt3 at the corners, middles and thirds of sides of triangles, which two steps cut into nine:
// these are vertices of levels 0, 1 and 2, whose limit masks are exact.
#include <algorithm>
#include <string>

#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"

namespace sublimit::testing {

/// Returns the first place where the surface's stencil differs from L_k P_k of the vertex; empty if there is
/// none. Thirds of a side are evaluated in both of its triangles.
inline std::string wrong_at_thirds(const LimitMap& surface, const Scheme<double>& scheme) {
  const Level one = next_level(scheme, surface.level()), two = next_level(scheme, one);
  const SparseMatrix P = two.S * one.S;
  LimitCache cache(scheme);
  const SparseMatrix corners = limit_matrices(surface.level(), cache).position,
                     middles = limit_matrices(one, cache).position * one.S,
                     thirds = limit_matrices(two, cache).position * P;
  const Topology& t = surface.level().topology();
  const Refinement &first = one.steps.back(), &second = two.steps.back();
  // A half-edge's triangle of level 1 is cut at its middle, or at its border.
  const auto third = [&](HalfEdge h) {
    if (!exists(t.twin(h))) {
      const auto rank = std::lower_bound(second.borders.begin(), second.borders.end(), 3 * index(h));
      return second.first_border_child() + 2 * static_cast<Index>(rank - second.borders.begin());
    }
    if (second.face_list.empty()) return index(second.child(Face{index(h)}));
    const auto rank = std::lower_bound(second.face_list.begin(), second.face_list.end(), index(h));
    return second.from_vertices + static_cast<Index>(rank - second.face_list.begin());
  };
  const auto difference = [&](const Place& s, const SparseMatrix& rows, Index row) -> std::string {
    const LimitStencil stencil = surface.stencil(s);
    Eigen::RowVectorXd x = -Eigen::RowVectorXd(rows.row(row));
    const double size = x.cwiseAbs().sum();
    for (size_t j = 0; j < stencil.vertices.size(); ++j) x[stencil.vertices[j]] += stencil.weights(0, Eigen::Index(j));
    if (x.cwiseAbs().sum() <= reference * size) return {};
    return "triangle " + std::to_string(s.face) + " (" + std::to_string(s.u) + ", " + std::to_string(s.v) +
           ") is off by " + std::to_string(x.cwiseAbs().sum());
  };
  for (Index i = 0; i < t.num_half_edges(); ++i) {
    const HalfEdge h{i}, g = t.twin(h);
    const auto from = [&](HalfEdge corner, double a) {  // a of the way along it
      const Index k = t.corner_index(corner);
      return Place{index(t.face(corner)), k == 0 ? a : k == 1 ? 1 - a : 0, k == 0 ? 0 : k == 1 ? a : 1 - a};
    };
    std::string wrong = difference(from(h, 0), corners, index(t.tail(h)));
    if (wrong.empty() && t.corner_index(h) == 0)
      wrong = difference({index(t.face(h)), 1.0 / 3, 1.0 / 3}, middles, index(first.child(t.face(h))));
    if (wrong.empty()) wrong = difference(from(h, 1.0 / 3), thirds, third(h));
    if (wrong.empty() && exists(g)) wrong = difference(from(g, 2.0 / 3), thirds, third(h));
    if (wrong.empty() && !exists(g)) wrong = difference(from(h, 2.0 / 3), thirds, third(h) + 1);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace sublimit::testing
