// SPDX-License-Identifier: Apache-2.0
#include "sublimit/lattice_points.h"

#include "sublimit/base/parallel_for.h"

namespace sublimit {

Index Lattice::on_side(int k, Index s) const {
  if (triangle) return k == 0 ? row(s, 0) : k == 1 ? row(n - s, s) : row(0, n - s);
  return k == 0 ? row(s, 0) : k == 1 ? row(n, s) : k == 2 ? row(n - s, n) : row(0, n - s);
}

LatticePoints::LatticePoints(const Topology& t, const Lattice& lattice, std::vector<std::int8_t> turn)
    : lattice_(lattice),
      turn_(std::move(turn)),
      share_(t.num_faces()),
      first_(t.num_faces(), -1),
      of_vertex_(t.num_vertices(), -1),
      places_(lattice.size()),
      rank_(256) {
  const int sides = lattice.num_sides();
  for (int k = 0; k < sides; ++k)
    for (Index s = 0; s < lattice.n; ++s) places_[lattice.on_side(k, s)] = {static_cast<std::int8_t>(k), s};
  for (Index h = t.num_half_edges(); h-- > 0;) of_vertex_[index(t.tail(HalfEdge{h}))] = h;
  parallel_for(t.num_faces(), [&](std::int64_t f) {
    const Face face{static_cast<Index>(f)};
    int share = 0;
    for (int k = 0; k < sides; ++k) {
      const HalfEdge h = t.corner(face, (turn_[f] + k) % sides);
      if (t.half_edge(t.edge(h)) == h) share |= 1 << k;
      if (of_vertex_[index(t.tail(h))] == index(h)) share |= 16 << k;
    }
    share_[f] = static_cast<std::uint8_t>(share);
  });
  std::vector<bool> occurs(256, false);
  for (const std::uint8_t share : share_) occurs[share] = true;
  for (int share = 0; share < 256; ++share) {
    if (!occurs[share]) continue;
    rank_[share].assign(lattice.size(), -1);
    Index next = 0;
    for (const std::int32_t row : rows(static_cast<std::uint8_t>(share))) rank_[share][row] = next++;
  }
}

std::vector<std::int32_t> LatticePoints::rows(std::uint8_t share) const {
  std::vector<std::int32_t> rows;
  lattice_.for_each_inner([&](Index row) { rows.push_back(row); });
  for (int k = 0; k < lattice_.num_sides(); ++k)
    for (Index s = 1; s < lattice_.n && (share >> k & 1); ++s) rows.push_back(lattice_.on_side(k, s));
  for (int k = 0; k < lattice_.num_sides(); ++k)
    if (share >> (4 + k) & 1) rows.push_back(lattice_.on_side(k, 0));
  return rows;
}

std::int64_t LatticePoints::point(const Topology& t, Face face, Index row) const {
  if (const Index rank = rank_[share(face)][row]; rank >= 0) return first_[index(face)] + rank;
  const auto [side_here, step] = places_[row];
  const HalfEdge h = t.corner(face, (turn(face) + side_here) % lattice_.num_sides());
  HalfEdge owner;
  Index at = step;
  if (step == 0) {
    owner = HalfEdge{of_vertex_[index(t.tail(h))]};
  } else {
    owner = t.half_edge(t.edge(h));
    // Twins run against each other, other half-edges of a non-manifold edge perhaps.
    if (t.twin(h) == owner || t.tail(h) != t.tail(owner)) at = lattice_.n - step;
  }
  return first_[index(t.face(owner))] + rank_[share(t.face(owner))][lattice_.on_side(side(t, owner), at)];
}

}  // namespace sublimit
