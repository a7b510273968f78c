// SPDX-License-Identifier: Apache-2.0
#pragma once
// Renumbered parts of levels: some faces of a level as a new level. Twins, non-manifold edges, sharpness of
// edges and holes are kept; half-edges whose twin is not among the faces have none.
#include <algorithm>
#include <span>
#include <vector>

#include "sublimit/mesh/detail/topology_builder.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Faces under their new numbers.
struct RenumberedFaces {
  std::vector<Index> faces;    ///< number of each face in the whole
  std::vector<Index> offsets;  ///< start of the corners of each face, #faces + 1
  std::vector<Index> corners;  ///< half-edges of the whole, face by face; a face may start at any of its corners
};

/// Returns the part.
/// @param half    returns the new number of a half-edge of the whole, or -1
/// @param vertex  returns the new number of a vertex of the whole
/// @return  a level without a matrix; the caller must fill the sharpness of vertices
template <class Half, class Vertex>
Level renumbered_level(const Level& whole, const RenumberedFaces& part, Index num_vertices, const Half& half,
                       const Vertex& vertex) {
  const Topology& t = whole.topology();
  TopologyBuilder b;
  b.face_offsets = part.offsets;
  const auto corners = static_cast<Index>(part.corners.size());
  b.tail.resize(corners);
  b.twin.resize(corners);
  for (Index i = 0; i < corners; ++i) {
    const HalfEdge h{part.corners[i]}, twin = t.twin(h);
    b.tail[i] = vertex(index(t.tail(h)));
    b.twin[i] = exists(twin) ? half(index(twin)) : -1;
    if (exists(twin) || !t.is_nonmanifold(t.edge(h))) continue;
    std::vector<Index> group;
    for (const HalfEdge g : t.half_edges(t.edge(h)))
      if (const Index own_half = half(index(g)); own_half >= 0) group.push_back(own_half);
    std::sort(group.begin(), group.end());
    if (group[0] == i) b.nonmanifold_edges.push_back(std::move(group));
  }
  b.find_fans(num_vertices);

  Level level;
  level.number = whole.number;
  level.made_by = whole.made_by;
  level.steps.emplace_back();
  level.steps[0].topology = std::move(b).build();
  const Topology& own = level.topology();
  level.sharpness.creasing = whole.sharpness.creasing;
  level.sharpness.edge.resize(own.num_edges());
  for (Index i = 0; i < corners; ++i)
    level.sharpness.edge[index(own.edge(HalfEdge{i}))] = whole.sharpness.edge[index(t.edge(HalfEdge{part.corners[i]}))];
  level.intervals = renumbered(whole.intervals, t, own, [&](HalfEdge h) { return part.corners[index(h)]; });
  for (const Index f : part.faces) level.holes.push_back(whole.holes[f]);
  return level;
}

}  // namespace sublimit
