// SPDX-License-Identifier: Apache-2.0
#pragma once
// Who has which point: points on a side or at a corner belong to one of the faces there, the others look them up, so
// that every point is made once.
#include <cstdint>
#include <vector>

#include "sublimit/mesh/topology.h"

namespace sublimit {

/// Points of level k on a face, both ends of all sides included.
///
/// Quadrilaterals: (i, j) with i, j <= n = 2^k at the parameters (i, j) / n; triangles: i + j <= n. Rows by j, then i.
struct Lattice {
  Index n = 1;
  bool triangle = false;
  Index size() const { return triangle ? (n + 1) * (n + 2) / 2 : (n + 1) * (n + 1); }
  Index row(Index i, Index j) const { return triangle ? j * (n + 1) - j * (j - 1) / 2 + i : j * (n + 1) + i; }
  int num_sides() const { return triangle ? 3 : 4; }
  /// The point s steps along side k, from its first corner.
  Index on_side(int k, Index s) const;
  /// Calls body(row) for all points inside.
  template <class Body>
  void for_each_inner(const Body& body) const {
    for (Index j = 1; j < n; ++j)
      for (Index i = 1; i < (triangle ? n - j : n); ++i) body(row(i, j));
  }
};

/// Numbers of the points of a mesh's faces, each of which has a lattice with a first corner of its own.
class LatticePoints {
 public:
  LatticePoints() = default;
  /// @param turn  of each face: its corner that is the lattice's first one
  LatticePoints(const Topology& topology, const Lattice& lattice, std::vector<std::int8_t> turn);

  const Lattice& lattice() const { return lattice_; }
  int turn(Face face) const { return turn_[index(face)]; }
  /// What a face has besides its inside: bit k for the inside of side k, 4 + k for its first corner.
  std::uint8_t share(Face face) const { return share_[index(face)]; }
  /// Rows of the lattice that faces with this share have, in the order of their points.
  std::vector<std::int32_t> rows(std::uint8_t share) const;
  /// Says that a face's points begin with this one.
  void set_first(Face face, std::int64_t point) { first_[index(face)] = point; }
  /// @param topology  that this was made for
  std::int64_t point(const Topology& topology, Face face, Index row) const;

 private:
  struct Place {
    std::int8_t side = -1;  // -1: inside
    Index step = 0;
  };
  int side(const Topology& t, HalfEdge h) const {
    return (t.corner_index(h) - turn(t.face(h)) + lattice_.num_sides()) % lattice_.num_sides();
  }
  Lattice lattice_;
  std::vector<std::int8_t> turn_;
  std::vector<std::uint8_t> share_;
  std::vector<std::int64_t> first_;
  std::vector<Index> of_vertex_;          // the half-edge that has it: the first one
  std::vector<Place> places_;             // of each row
  std::vector<std::vector<Index>> rank_;  // of each row among those of a share; -1: it is another's
};

}  // namespace sublimit
