// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/regular_faces.h"

#include <array>

#include "sublimit/base/detail/parallel_for.h"

namespace sublimit {

RegularFaces::RegularFaces(const Level& level, int corners)
    : t_(level.topology()), corners_(corners), regular_(t_.num_faces(), 0) {
  std::vector<std::uint8_t> plain(t_.num_vertices(), 0);
  const int valence = corners == 3 ? 6 : 4;
  parallel_for(t_.num_vertices(), [&](std::int64_t i) {
    const Vertex v{static_cast<Index>(i)};
    if (t_.is_isolated(v) || t_.is_nonmanifold(v) || level.sharpness.vertex[i] != 0) return;
    const HalfEdge first = t_.outgoing(v);
    HalfEdge h = first;
    int faces = 0;
    do {
      if (++faces > valence || t_.size(t_.face(h)) != corners || level.sharpness.edge[index(t_.edge(h))] != 0) return;
      h = t_.ccw(h);
    } while (exists(h) && h != first);
    plain[i] = exists(h) && faces == valence;
  });
  parallel_for(t_.num_faces(), [&](std::int64_t i) {
    const Face face{static_cast<Index>(i)};
    for (const Index v : t_.vertices(face))
      if (!plain[v]) return;
    std::array<Index, 16> points;
    find_points(face, points.data());
    const int count = num_points();
    int equal = 0;  // each is equal to itself
    for (int k = 0; k < count; ++k)
      for (int j = 0; j < count; ++j) equal += points[j] == points[k];
    regular_[i] = equal == count;
  });
}

bool RegularFaces::points(Face face, Index* out) const {
  if (!is_regular(face)) return false;
  find_points(face, out);
  return true;
}

void RegularFaces::find_points(Face face, Index* out) const {
  const HalfEdge own[4] = {t_.corner(face, 0), t_.corner(face, 1), t_.corner(face, 2),
                           corners_ == 4 ? t_.corner(face, 3) : no_half_edge};
  for (int k = 0; k < corners_; ++k) *out++ = index(t_.tail(own[k]));
  // Around each corner counter-clockwise; what the corners before have seen is left out.
  const auto beside = [&](HalfEdge g) { *out++ = index(t_.tail(t_.prev(g))); };
  const auto across = [&](HalfEdge g) { *out++ = index(t_.tail(t_.next(t_.next(g)))); };
  const auto turned = [&](HalfEdge g, int steps) {
    for (; steps > 0; --steps) g = t_.ccw(g);
    return g;
  };
  if (corners_ == 4) {
    HalfEdge g = turned(own[0], 1);
    across(g), beside(g);
    g = turned(g, 1);
    across(g), beside(g);
    across(turned(g, 1));
    for (int k = 1; k < 3; ++k) {
      g = turned(own[k], 2);
      across(g), beside(g);
      across(turned(g, 1));
    }
    across(turned(own[3], 2));
    return;
  }
  HalfEdge g = own[0];
  for (int k = 0; k < 4; ++k) beside(g = turned(g, 1));
  g = turned(own[1], 1);
  for (int k = 0; k < 3; ++k) beside(g = turned(g, 1));
  g = turned(own[2], 1);
  for (int k = 0; k < 2; ++k) beside(g = turned(g, 1));
}

}  // namespace sublimit
