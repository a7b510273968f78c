// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/canonical_part.h"

#include <algorithm>
#include <tuple>

#include "sublimit/scheme/detail/renumbered_level.h"

namespace sublimit {

CanonicalPart canonical_part(const Level& part, const std::vector<Index>& slots) {
  const Topology& t = part.topology();
  std::vector<Index> number(t.num_vertices(), -1);
  Index next = 0;
  for (const Index v : slots) number[v] = next++;
  for (Index& n : number)
    if (n < 0) n = next++;

  // Faces by their corners, each from its least one on; those with corners that are no slots last.
  struct Entry {
    bool beyond = false;
    std::vector<Index> corners;
    Index face = 0, first = 0;
  };
  std::vector<Entry> faces(t.num_faces());
  const auto num_slots = static_cast<Index>(slots.size());
  for (Index f = 0; f < t.num_faces(); ++f) {
    Entry& entry = faces[f];
    entry.face = f;
    const std::span<const Index> vertices = t.vertices(Face{f});
    for (const Index v : vertices) entry.corners.push_back(number[v]);
    const auto least = std::min_element(entry.corners.begin(), entry.corners.end());
    entry.first = static_cast<Index>(least - entry.corners.begin());
    entry.beyond = *std::max_element(entry.corners.begin(), entry.corners.end()) >= num_slots;
    std::rotate(entry.corners.begin(), entry.corners.begin() + entry.first, entry.corners.end());
  }
  std::sort(faces.begin(), faces.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.beyond, a.corners, a.face) < std::tie(b.beyond, b.corners, b.face);
  });

  CanonicalPart result;
  result.half_edge.resize(t.num_half_edges());
  RenumberedFaces order{.faces = {}, .offsets = {0}, .corners = {}};
  for (const Entry& entry : faces) {
    const auto size = static_cast<Index>(entry.corners.size());
    for (Index k = 0; k < size; ++k) {
      const HalfEdge h = t.corner(Face{entry.face}, (entry.first + k) % size);
      result.half_edge[index(h)] = static_cast<Index>(order.corners.size());
      order.corners.push_back(index(h));
    }
    order.faces.push_back(entry.face);
    order.offsets.push_back(static_cast<Index>(order.corners.size()));
  }
  result.level = renumbered_level(
      part, order, t.num_vertices(), [&](Index h) { return result.half_edge[h]; }, [&](Index v) { return number[v]; });
  UninitializedVector<float>& sharpness = result.level.sharpness.vertex;
  sharpness.resize(t.num_vertices());
  for (Index v = 0; v < t.num_vertices(); ++v) sharpness[number[v]] = part.sharpness.vertex[v];
  return result;
}

}  // namespace sublimit
