// SPDX-License-Identifier: Apache-2.0
#include "sublimit/analysis/walk.h"

#include <unordered_map>

#include "sublimit/analysis/local_type.h"

namespace sublimit {

Walk walk(const Topology& t, const Sharpness& sharpness, const Centre& centre, int depth) {
  Walk result;
  std::unordered_map<Index, Index> slot_of;
  std::vector<HalfEdge> found_at;  // a half-edge that leaves the point, by slot
  const auto slot = [&](HalfEdge h) {
    const auto [at, is_new] = slot_of.try_emplace(index(t.tail(h)), static_cast<Index>(result.vertices.size()));
    if (is_new) {
      result.vertices.push_back(index(t.tail(h)));
      found_at.push_back(h);
    }
    return static_cast<std::uint32_t>(at->second);
  };
  const auto is_cut = [&](HalfEdge h) { return !exists(t.twin(h)) || is_sharp(sharpness.edge[index(t.edge(h))]); };

  result.signature.push_back(static_cast<std::uint32_t>(centre.kind));
  slot(centre.start);
  if (centre.kind == Centre::Kind::face)
    for (HalfEdge h = t.next(centre.start); h != centre.start; h = t.next(h)) slot(h);
  if (centre.kind == Centre::Kind::border) slot(t.next(centre.start));
  result.ring_end.push_back(static_cast<Index>(result.vertices.size()));

  size_t next = 0;
  for (int ring = 0; ring < depth; ++ring) {
    const size_t end = result.vertices.size();
    for (; next < end; ++next) {
      HalfEdge first = found_at[next], h = first;
      std::uint32_t back = 0;
      bool open = false;
      while (!is_cut(h)) {  // clockwise to the first half-edge of the fan, if it is open
        h = t.next(t.twin(h));
        if (h == found_at[next]) break;
        ++back;
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
      for (;;) {
        ++faces;
        result.signature.push_back(static_cast<std::uint32_t>(t.size(t.face(h))));
        HalfEdge g = h;
        do {
          result.signature.push_back(slot(g));
          g = t.next(g);
        } while (g != h);
        const HalfEdge into = t.prev(h);
        if (is_cut(into)) break;
        h = t.twin(into);
        if (h == first) break;
      }
      const bool sharp = open && is_corner(t, sharpness, Vertex{result.vertices[next]});
      result.signature[head] = 4 * faces + 2 * (open ? 1 : 0) + (sharp ? 1 : 0);
      result.signature[head + 1] = back;
      result.on_border.push_back(open);
    }
    result.ring_end.push_back(static_cast<Index>(result.vertices.size()));
  }
  return result;
}

}  // namespace sublimit
