// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places on sides, which belong to several squares or triangles: a number for each point of the surface, by
// connectivity alone, never by where it is.
#include <cstdint>

#include "sublimit/limit/address.h"

namespace sublimit {

class SharedPlaces {
 public:
  static constexpr std::int64_t nobody = -1;

  /// @param topology, addresses  which must stay
  /// @param steps  along each side
  /// @param dual   of a dual scheme, which has a border on each side of a non-manifold edge, and a corner for each fan
  ///               of a vertex
  SharedPlaces(const Topology& topology, const Addresses& addresses, std::int64_t steps, bool dual)
      : t_(topology), addresses_(addresses), steps_(steps), dual_(dual) {}
  SharedPlaces(const Topology&&, const Addresses&, std::int64_t, bool) = delete;
  SharedPlaces(const Topology&, const Addresses&&, std::int64_t, bool) = delete;

  /// Returns the number of a place; places with equal numbers are the same point.
  /// @param i, j  in steps along u and v
  /// @return  `nobody` inside, and where no other square has the point
  std::int64_t number(Index address, std::int64_t i, std::int64_t j) const;
  /// Returns an upper bound of all numbers.
  std::int64_t size() const;

 private:
  std::int64_t at_tail(HalfEdge h) const;
  /// @param from_tail  in half steps: squares of polygons have half an edge each
  std::int64_t on_edge(HalfEdge h, std::int64_t from_tail) const;
  /// Between two squares of a polygon, from the middle of an edge to the middle of the face.
  std::int64_t on_spoke(HalfEdge h, std::int64_t k) const;

  // Numbers count vertices, then places on edges, then places between the squares of a polygon, then what dual schemes
  // have apart.
  std::int64_t first_inside() const { return t_.num_vertices() + std::int64_t(t_.num_edges()) * (2 * steps_ - 1); }
  std::int64_t first_apart() const { return first_inside() + std::int64_t(t_.num_half_edges()) * (steps_ + 1); }

  const Topology& t_;
  const Addresses& addresses_;
  std::int64_t steps_;
  bool dual_;
};

}  // namespace sublimit
