// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers for places on the sides of addresses, which several squares or triangles share: one number for each
// point of the surface, decided by connectivity alone, never by coordinates.
#include <cstdint>

#include "sublimit/source/address.h"

namespace sublimit {

/// Numbers of the places of a regular grid on the sides of addresses.
class SharedPlaces {
 public:
  /// The result of `number` for a place that no other address has.
  static constexpr std::int64_t not_shared = -1;

  /// @param topology, addresses  must outlive this
  /// @param steps  number of steps along each side of an address
  /// @param dual   whether the scheme is dual: its surface has a separate border for each face at a
  ///               non-manifold edge, and a separate corner for each fan of a vertex
  SharedPlaces(const Topology& topology, const Addresses& addresses, std::int64_t steps, bool dual)
      : t_(topology), addresses_(addresses), steps_(steps), dual_(dual) {}
  SharedPlaces(const Topology&&, const Addresses&, std::int64_t, bool) = delete;
  SharedPlaces(const Topology&, const Addresses&&, std::int64_t, bool) = delete;

  /// Returns the number of a place; places with equal numbers are the same point.
  /// @param i, j  steps along u and v
  /// @return  -1, the constant `not_shared`, if no other address shares the place
  std::int64_t number(Index address, std::int64_t i, std::int64_t j) const;
  /// Returns an upper bound of all numbers.
  std::int64_t size() const;

 private:
  /// Returns the number of the tail of a half-edge.
  std::int64_t at_tail(HalfEdge h) const;
  /// Returns the number of a place on an edge.
  /// @param from_tail  distance from the tail in half steps: the squares of a polygon have half an edge each
  std::int64_t on_edge(HalfEdge h, std::int64_t from_tail) const;
  /// Returns the number of a place between two squares of a polygon, k steps from the middle of an edge towards
  /// the middle of the face.
  std::int64_t on_spoke(HalfEdge h, std::int64_t k) const;

  // Numbers count vertices, then places on edges, then places between the squares of a polygon, then the
  // separate corners and border midpoints of dual schemes.
  std::int64_t first_inside() const { return t_.num_vertices() + std::int64_t(t_.num_edges()) * (2 * steps_ - 1); }
  std::int64_t first_apart() const { return first_inside() + std::int64_t(t_.num_half_edges()) * (steps_ + 1); }

  const Topology& t_;
  const Addresses& addresses_;
  std::int64_t steps_;
  bool dual_;
};

}  // namespace sublimit
