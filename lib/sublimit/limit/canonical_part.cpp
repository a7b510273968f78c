// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/canonical_part.h"

#include <algorithm>
#include <tuple>

#include "sublimit/mesh/topology_builder.h"

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
  TopologyBuilder b;
  b.face_offsets = {0};
  Index at = 0;
  for (const Entry& entry : faces) {
    const auto size = static_cast<Index>(entry.corners.size());
    for (Index k = 0; k < size; ++k) {
      result.half_edge[index(t.corner(Face{entry.face}, (entry.first + k) % size))] = at++;
      b.tail.push_back(entry.corners[k]);
    }
    b.face_offsets.push_back(at);
  }
  b.twin.assign(t.num_half_edges(), -1);
  for (Index h = 0; h < t.num_half_edges(); ++h)
    if (const HalfEdge g = t.twin(HalfEdge{h}); exists(g)) b.twin[result.half_edge[h]] = result.half_edge[index(g)];
  for (Index e = 0; e < t.num_edges(); ++e) {
    if (exists(t.twin(t.half_edge(Edge{e}))) || !t.is_nonmanifold(Edge{e})) continue;
    std::vector<Index> group;
    for (const HalfEdge h : t.half_edges(Edge{e})) group.push_back(result.half_edge[index(h)]);
    std::sort(group.begin(), group.end());
    b.nonmanifold_edges.push_back(std::move(group));
  }
  std::sort(b.nonmanifold_edges.begin(), b.nonmanifold_edges.end());
  b.find_fans(t.num_vertices());

  Level& level = result.level;
  level.number = part.number;
  level.steps.emplace_back();
  level.steps[0].topology = std::move(b).build();
  const Topology& own = level.topology();
  level.sharpness.creasing = part.sharpness.creasing;
  level.sharpness.vertex.resize(t.num_vertices());
  for (Index v = 0; v < t.num_vertices(); ++v) level.sharpness.vertex[number[v]] = part.sharpness.vertex[v];
  level.sharpness.edge.resize(own.num_edges());
  for (Index h = 0; h < t.num_half_edges(); ++h)
    level.sharpness.edge[index(own.edge(HalfEdge{result.half_edge[h]}))] =
        part.sharpness.edge[index(t.edge(HalfEdge{h}))];
  for (const Entry& entry : faces) level.holes.push_back(part.holes[entry.face]);
  return result;
}

}  // namespace sublimit
