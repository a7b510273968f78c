// SPDX-License-Identifier: Apache-2.0
#include "sublimit/face_owners.h"

#include "sublimit/base/parallel_for.h"

namespace sublimit {

FaceLattices::Arrays face_owners(const Topology& t, const Lattice& lattice, std::span<const std::int8_t> turn) {
  const int sides = lattice.num_sides();
  const size_t all = size_t(t.num_faces()) * size_t(sides);
  std::vector<Index> of_vertex(t.num_vertices(), -1);
  for (Index h = t.num_half_edges(); h-- > 0;) of_vertex[index(t.tail(HalfEdge{h}))] = h;
  std::vector<std::int32_t> side_faces(all), corner_faces(all);
  std::vector<std::uint8_t> side_places(all), corner_places(all);
  const auto side = [&](HalfEdge h) { return (t.corner_index(h) - turn[index(t.face(h))] + sides) % sides; };
  parallel_for(t.num_faces(), [&](std::int64_t f) {
    const Face face{static_cast<Index>(f)};
    for (int k = 0; k < sides; ++k) {
      const HalfEdge h = t.corner(face, (turn[f] + k) % sides);
      const size_t at = size_t(f) * size_t(sides) + size_t(k);
      const HalfEdge first = t.half_edge(t.edge(h));
      // Twins run against each other, other half-edges of a non-manifold edge perhaps.
      const bool against = first != h && (t.twin(h) == first || t.tail(h) != t.tail(first));
      side_faces[at] = index(t.face(first));
      side_places[at] = static_cast<std::uint8_t>(side(first) + (against ? 8 : 0));
      const HalfEdge leaving{of_vertex[index(t.tail(h))]};
      corner_faces[at] = index(t.face(leaving));
      corner_places[at] = static_cast<std::uint8_t>(side(leaving));
    }
  });
  FaceLattices::Arrays arrays;
  arrays.lattice = lattice;
  arrays.side_faces = std::move(side_faces);
  arrays.side_places = std::move(side_places);
  arrays.corner_faces = std::move(corner_faces);
  arrays.corner_places = std::move(corner_places);
  return arrays;
}

}  // namespace sublimit
