// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points of a table on lattices, one for each face. A point on a side or at a corner belongs to one of the faces there,
// and the other faces refer to it, so that every point is made once. Faces between points follow from the lattices and
// are not stored:
//
//   const FaceLattices& lattices = *baked.lattices;  // baked: BakedTable<float> of a level by patterns
//   const Lattice& lattice = lattices.lattice();
//   lattice.for_each([&](std::int32_t i, std::int32_t j) {
//     const std::int64_t point = lattices.point(0, lattice.row(i, j));  // on face 0
//     if (lattices.has_addresses()) use(point, lattices.place(0).address, lattices.parameters(0, i, j));
//   });
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/eval/table/shared_array.h"

namespace sublimit {

/// A lattice of points on a face, its sides and corners included.
///
/// Points are (i, j) at the parameters (i, j) / n, with i, j <= n on a quadrilateral, and i + j <= n on a triangle.
/// They are numbered by j, then i: the number is the row of the point. Sides and corners count counter-clockwise from
/// (0, 0); side k runs from corner k to the next one.
struct Lattice {
  std::int32_t n = 1;     ///< cells along a side
  bool triangle = false;  ///< true for triangles, false for quadrilaterals
  /// Returns the number of points.
  std::int32_t size() const { return triangle ? (n + 1) * (n + 2) / 2 : (n + 1) * (n + 1); }
  /// Returns the number of cells, which are quadrilaterals or triangles.
  std::int32_t num_cells() const { return n * n; }
  /// Returns the row of the point (i, j).
  std::int32_t row(std::int32_t i, std::int32_t j) const {
    return triangle ? j * (n + 1) - j * (j - 1) / 2 + i : j * (n + 1) + i;
  }
  int num_sides() const { return triangle ? 3 : 4; }
  /// Returns the row of the point s steps along side k from its first corner.
  std::int32_t on_side(int k, std::int32_t s) const;
  /// Calls body(row) for all points that are on no side.
  template <class Body>
  void for_each_inner(const Body& body) const {
    for (std::int32_t j = 1; j < n; ++j)
      for (std::int32_t i = 1; i < (triangle ? n - j : n); ++i) body(row(i, j));
  }
  /// Calls body(i, j) for all points, row by row.
  template <class Body>
  void for_each(const Body& body) const {
    for (std::int32_t j = 0; j <= n; ++j)
      for (std::int32_t i = 0; i <= (triangle ? n - j : n); ++i) body(i, j);
  }
};

/// Position of a lattice in a face of the surface, as places (face, u, v) count faces. The lattice covers the whole
/// face, or the quarter of it at one corner.
struct LatticePlace {
  std::int32_t address = 0;  ///< face of places
  std::int8_t turn = 0;      ///< corner of the face, or of its quarter, where the lattice has its point (0, 0)
  std::int8_t quarter = -1;  ///< corner whose quarter the lattice covers; -1: the whole face
};

/// Parameters (u, v) of a place.
struct AddressParameters {
  double u = 0, v = 0;
};
/// Returns the parameters of the point (i, j) of a lattice in its face of the surface.
AddressParameters address_parameters(const Lattice& lattice, const LatticePlace& place, std::int32_t i, std::int32_t j);

/// Order of the points that a face owns: those inside, then those on its own sides, then its own corners.
///
/// Threads may share it while none of them calls `add`.
class LatticeRanks {
 public:
  /// The sides and corners that a face owns: bit k for the inside of side k, bit 4 + k for corner k.
  using Share = std::uint8_t;
  LatticeRanks() = default;
  /// Makes the ranks of a lattice, of no share yet.
  explicit LatticeRanks(const Lattice& lattice);

  /// Returns the rows of the lattice that a face with this share owns, in the order of its points.
  static std::vector<std::int32_t> rows(const Lattice& lattice, Share share);
  /// Computes the ranks of a share. To be called for every share that is asked for below.
  void add(Share share);
  /// Returns the number of points that a face with this share owns.
  std::int32_t num_rows(Share share) const { return count_[share]; }
  /// Returns the rank of a row among those of a share; -1: another face owns the point.
  std::int32_t rank(Share share, std::int32_t row) const { return rank_[share][size_t(row)]; }

  /// Position of a row on the boundary of the lattice.
  struct OnSide {
    std::int8_t side = -1;  ///< side of the face; -1: the row is inside
    std::int32_t step = 0;  ///< steps from the side's first corner; 0: the corner
  };
  /// Returns the position of a row on the boundary of the lattice.
  OnSide on_side(std::int32_t row) const { return places_[size_t(row)]; }

 private:
  Lattice lattice_;
  std::vector<OnSide> places_;                   // of each row
  std::vector<std::vector<std::int32_t>> rank_;  // by share, then by row
  std::vector<std::int32_t> count_;              // by share; -1: not asked for
};

/// Lattices of all faces, and the owners of the points on their sides. Constant once made: any number of threads may
/// share it, and copies share the arrays.
class FaceLattices {
 public:
  /// Arrays of F faces; the entries of a face's S sides or corners follow each other.
  struct Arrays {
    Lattice lattice;                          ///< lattice of every face
    SharedArray<std::int32_t> side_faces;     ///< owner of the points of each side, F x S
    SharedArray<std::uint8_t> side_places;    ///< the side's number there; 8 more if it runs the other way, F x S
    SharedArray<std::int32_t> corner_faces;   ///< owner of the point at each corner, F x S
    SharedArray<std::uint8_t> corner_places;  ///< the corner's number there, F x S
    SharedArray<std::int64_t> first_points;   ///< first of each face's own points, F; in the order of `LatticeRanks`
    SharedArray<std::int32_t> addresses;      ///< `LatticePlace::address` of each face, F; or empty
    SharedArray<std::uint8_t> places;         ///< `code` of each face's place, F; empty if `addresses` is
    SharedArray<std::uint8_t> holes;          ///< 1 for faces that are holes, else 0, F; or empty
  };
  FaceLattices() = default;
  /// Makes lattices of arrays.
  /// @param num_points  number of points of the table
  /// @throws InvalidParameter  arrays that do not fit together, a number out of range, an owner without the points
  FaceLattices(std::int64_t num_points, Arrays arrays);

  const Arrays& arrays() const { return arrays_; }
  const Lattice& lattice() const { return arrays_.lattice; }  ///< lattice of every face
  std::int32_t num_faces() const { return static_cast<std::int32_t>(arrays_.first_points.size()); }
  /// Returns true if a face is a hole: its points exist, but it is not part of the surface.
  bool is_hole(std::int32_t face) const { return !arrays_.holes.empty() && arrays_.holes[face] != 0; }
  /// Returns the sides and corners that a face owns.
  static LatticeRanks::Share share(const Arrays& arrays, std::int32_t face);
  /// Returns the index of the point at a row of a face's lattice.
  std::int64_t point(std::int32_t face, std::int32_t row) const;
  /// Returns true if the places of faces are recorded, which `place` and `parameters` need.
  bool has_addresses() const { return !arrays_.addresses.empty(); }
  /// Returns where the lattice of a face lies on the surface.
  LatticePlace place(std::int32_t face) const;
  /// Returns the number that stands for a place in `Arrays::places`: `turn` + 8 * (`quarter` + 1).
  static std::uint8_t code(const LatticePlace& place) {
    return static_cast<std::uint8_t>(place.turn + 8 * (place.quarter + 1));
  }
  /// Returns (u, v) of the point (i, j) of a face's lattice, in the face of `place(face)`.
  AddressParameters parameters(std::int32_t face, std::int32_t i, std::int32_t j) const {
    return address_parameters(lattice(), place(face), i, j);
  }

 private:
  Arrays arrays_;
  std::vector<std::uint8_t> share_;
  LatticeRanks ranks_;
};

}  // namespace sublimit
