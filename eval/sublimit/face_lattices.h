// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points on faces: each face has a lattice of them. Points on a side or at a corner belong to one of the faces there,
// the others look them up, so that every point is made once. What a table's points are joined by follows from this,
// and need not be stored.
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/shared_array.h"

namespace sublimit {

/// Points on a face, both ends of all sides included.
///
/// Quadrilaterals: (i, j) with i, j <= n at the parameters (i, j) / n; triangles: i + j <= n. Rows by j, then i. Sides
/// and corners count counter-clockwise from (0, 0); side k runs from corner k to the next one.
struct Lattice {
  std::int32_t n = 1;
  bool triangle = false;
  std::int32_t size() const { return triangle ? (n + 1) * (n + 2) / 2 : (n + 1) * (n + 1); }
  std::int32_t num_cells() const { return n * n; }
  std::int32_t row(std::int32_t i, std::int32_t j) const {
    return triangle ? j * (n + 1) - j * (j - 1) / 2 + i : j * (n + 1) + i;
  }
  int num_sides() const { return triangle ? 3 : 4; }
  /// The point s steps along side k, from its first corner.
  std::int32_t on_side(int k, std::int32_t s) const;
  /// Calls body(row) for all points inside.
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

/// Where a lattice lies in the address (face, u, v) that a user knows: its corner (0,0) is corner `turn` of the address
/// or of the quarter of it at one corner.
struct LatticePlace {
  std::int32_t address = 0;
  std::int8_t turn = 0;
  std::int8_t quarter = -1;  ///< -1: all of the address
};

/// (u, v) in an address.
struct AddressParameters {
  double u = 0, v = 0;
};
/// Those of the point (i, j) of a lattice.
AddressParameters address_parameters(const Lattice& lattice, const LatticePlace& place, std::int32_t i, std::int32_t j);

/// Where the points of a lattice stand among those that a face has: its inside, then its own sides, then its own
/// corners.
class LatticeRanks {
 public:
  /// What a face has besides its inside: bit k for the inside of side k, 4 + k for corner k.
  using Share = std::uint8_t;
  LatticeRanks() = default;
  explicit LatticeRanks(const Lattice& lattice);

  /// Rows of the lattice that faces with this share have, in the order of their points.
  static std::vector<std::int32_t> rows(const Lattice& lattice, Share share);
  /// To be called for every share that is asked for below.
  void add(Share share);
  std::int32_t num_rows(Share share) const { return count_[share]; }
  /// Of a row among those of a share; -1: it is another's.
  std::int32_t rank(Share share, std::int32_t row) const { return rank_[share][size_t(row)]; }

  /// Of a row on a side or at a corner (step 0).
  struct OnSide {
    std::int8_t side = -1;  ///< -1: inside
    std::int32_t step = 0;
  };
  OnSide on_side(std::int32_t row) const { return places_[size_t(row)]; }

 private:
  Lattice lattice_;
  std::vector<OnSide> places_;                   // of each row
  std::vector<std::vector<std::int32_t>> rank_;  // by share, then by row
  std::vector<std::int32_t> count_;              // by share; -1: not asked for
};

class FaceLattices {
 public:
  /// By face, then by side or corner of its lattice.
  struct Arrays {
    Lattice lattice;
    SharedArray<std::int32_t> side_faces;     ///< F x sides: the face that has the points of a side
    SharedArray<std::uint8_t> side_places;    ///< which side of that face it is; 8 more if it runs the other way there
    SharedArray<std::int32_t> corner_faces;   ///< F x sides: the face that has the point at a corner
    SharedArray<std::uint8_t> corner_places;  ///< which corner of that face it is
    SharedArray<std::int64_t>
        first_points;  ///< F: where a face's points begin; its inside, its own sides, its own corners
    /// F, or none: places in addresses, `turn` + 8 * (`quarter` + 1).
    SharedArray<std::int32_t> addresses;
    SharedArray<std::uint8_t> places;
    SharedArray<std::uint8_t> holes;  ///< F, or none: 1 for faces that are none of the surface
  };
  FaceLattices() = default;
  /// @param num_points  that there are
  /// @throws InvalidParameter  arrays that do not fit together, a number out of range, an owner that is none
  FaceLattices(std::int64_t num_points, Arrays arrays);

  const Arrays& arrays() const { return arrays_; }
  const Lattice& lattice() const { return arrays_.lattice; }
  std::int32_t num_faces() const { return static_cast<std::int32_t>(arrays_.first_points.size()); }
  bool is_hole(std::int32_t face) const { return !arrays_.holes.empty() && arrays_.holes[face] != 0; }
  static LatticeRanks::Share share(const Arrays& arrays, std::int32_t face);
  /// The point at a row of a face's lattice.
  std::int64_t point(std::int32_t face, std::int32_t row) const;
  /// Where a point is, if addresses are known: (u, v) of the address of a face.
  bool has_addresses() const { return !arrays_.addresses.empty(); }
  LatticePlace place(std::int32_t face) const;
  /// As `places` has it.
  static std::uint8_t code(const LatticePlace& place) {
    return static_cast<std::uint8_t>(place.turn + 8 * (place.quarter + 1));
  }
  AddressParameters parameters(std::int32_t face, std::int32_t i, std::int32_t j) const {
    return address_parameters(lattice(), place(face), i, j);
  }

 private:
  Arrays arrays_;
  std::vector<std::uint8_t> share_;
  LatticeRanks ranks_;
};

}  // namespace sublimit
