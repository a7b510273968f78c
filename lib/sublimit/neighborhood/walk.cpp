// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/walk.h"

#include <algorithm>
#include <unordered_map>

#include "sublimit/neighborhood/local_type.h"

namespace sublimit {

Walk walk(const Topology& t, const Sharpness& sharpness, const Centre& centre, int depth,
          const std::vector<std::uint32_t>* expected) {
  Walk result;
  std::unordered_map<std::int64_t, Index> slot_of;
  std::vector<HalfEdge> found_at;  // a half-edge that leaves the point, by slot
  const auto is_cut = [&](HalfEdge h) { return sublimit::is_cut(t, sharpness, h); };
  // Where sheets meet a point is one for each of its fans: on either side of an edge that ends inside a sheet, for one.
  // Edges and faces have the masks of their own side, so that the sheet is unfolded as far as it is looked at.
  const auto place = [&](HalfEdge h) -> std::int64_t {
    if (!t.is_nonmanifold(t.tail(h))) return index(t.tail(h));
    HalfEdge least = h, first = h;
    while (!is_cut(first)) {
      first = t.next(t.twin(first));
      if (first == h) break;
      least = std::min(least, first);
    }
    return std::int64_t{t.num_vertices()} + index(is_cut(first) ? first : least);
  };
  const auto slot = [&](HalfEdge h) {
    const auto [at, is_new] = slot_of.try_emplace(place(h), static_cast<Index>(result.vertices.size()));
    if (is_new) {
      result.vertices.push_back(index(t.tail(h)));
      found_at.push_back(h);
    }
    return static_cast<std::uint32_t>(at->second);
  };

  result.signature.push_back(static_cast<std::uint32_t>(centre.kind));
  slot(centre.start);
  if (centre.kind == Centre::Kind::face)
    for (HalfEdge h = t.next(centre.start); h != centre.start; h = t.next(h)) slot(h);
  if (centre.kind == Centre::Kind::border || centre.kind == Centre::Kind::edge) slot(t.next(centre.start));
  result.ring_end.push_back(static_cast<Index>(result.vertices.size()));

  size_t next = 0;
  for (int ring = 0; ring < depth; ++ring) {
    const size_t end = result.vertices.size();
    for (; next < end; ++next) {
      HalfEdge first = found_at[next], h = first;
      std::uint32_t back = 0;
      bool open = false;
      size_t compared = result.signature.size();
      if (expected && compared >= expected->size()) return result;
      const std::uint32_t most_faces = expected ? (*expected)[compared] / 4 : ~0u;
      while (!is_cut(h)) {  // clockwise to the first half-edge of the fan, if it is open
        h = t.next(t.twin(h));
        if (h == found_at[next]) break;
        if (++back > most_faces) return result;
      }
      if (is_cut(h)) {
        first = h;
        open = true;
      } else {
        back = 0;
      }
      std::uint32_t faces = 0;
      const size_t head = result.signature.size();
      result.signature.resize(head + 2);
      h = first;
      HalfEdge into = no_half_edge;
      for (;;) {
        ++faces;
        result.decays |= is_semi_sharp(sharpness.edge[index(t.edge(h))]);
        result.signature.push_back(static_cast<std::uint32_t>(t.size(t.face(h))));
        HalfEdge g = h;
        do {
          result.signature.push_back(slot(g));
          g = t.next(g);
        } while (g != h);
        if (faces > most_faces) return result;
        into = t.prev(h);
        if (is_cut(into)) break;
        h = t.twin(into);
        if (h == first) break;
      }
      const bool sharp = open && is_corner(t, sharpness, Vertex{result.vertices[next]});
      result.signature[head] = 4 * faces + 2 * (open ? 1 : 0) + (sharp ? 1 : 0);
      result.signature[head + 1] = back;
      // Between the two sides of one edge, but on a curve that goes on along another: the vertex has not its own rule.
      if (open && !sharp && t.edge(first) == t.edge(into)) result.signature.push_back(~0u);
      if (expected) {
        const size_t seen = result.signature.size();
        if (seen > expected->size()) return result;
        for (; compared < seen; ++compared)
          if (result.signature[compared] != (*expected)[compared]) return result;
      }
      result.on_border.push_back(open);
      result.decays |= is_semi_sharp(sharpness.vertex[result.vertices[next]]);
    }
    result.ring_end.push_back(static_cast<Index>(result.vertices.size()));
  }
  return result;
}

}  // namespace sublimit
