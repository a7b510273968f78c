// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control meshes with knot intervals that belong to points.
#include <random>

#include "sublimit/mesh/mesh.h"
#include "sublimit/mesh/topology.h"

namespace sublimit::testing {

/// Returns the mesh with random whole intervals up to `most` at both ends of all edges; opposite ends at a
/// vertex of four edges have the same one.
inline Mesh with_point_intervals(Mesh mesh, unsigned seed, unsigned most = 7) {
  std::mt19937 random(seed);
  const Topology t(view(mesh));
  for (Index i = 0; i < t.num_vertices(); ++i) {
    const HalfEdge first = t.outgoing(Vertex{i});
    const bool open = !exists(t.twin(first));
    const auto put = [&](Index w, double length) { mesh.knot_intervals.push_back({i, w, length}); };
    HalfEdge h = first;
    for (Index k = 0; exists(h); ++k, h = t.ccw(h)) {
      if (k > 0 && h == first) break;
      // The opposite end follows: the third of four, the last of a border's three.
      if (!open && t.num_faces(Vertex{i}) == 4 && k >= 2) break;
      put(index(t.head(h)), 1.0 + double(random() % most));
      if (open && !exists(t.ccw(h)) && t.num_faces(Vertex{i}) != 2)
        put(index(t.tail(t.prev(h))), 1.0 + double(random() % most));
    }
  }
  return mesh;
}

}  // namespace sublimit::testing
