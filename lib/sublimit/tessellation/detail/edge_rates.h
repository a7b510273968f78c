// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tessellation rates of the edges of a level (numbers of segments), and the edges of the sides of addresses.
#include <array>
#include <cstdint>
#include <span>

#include "sublimit/source/address.h"

namespace sublimit {

/// Throws unless rates are valid.
/// @throws InvalidParameter  another number of rates than edges, a rate below 1 or above 2^22
void check_edge_rates(const Topology& topology, std::span<const Index> rates);

/// The edge along a side of an address: a whole edge, or one half for a square of a polygon.
struct SideEdge {
  enum class Of { whole, first_half, second_half, none } of = Of::none;  ///< none: the side is inside a polygon
  Edge edge{};
};
/// Returns the edges along the sides of an address, counter-clockwise from (0, 0); three for triangles.
std::array<SideEdge, 4> side_edges(const Topology& topology, const Addresses& addresses, Index address);

/// Returns how long cells may be along each side of an address, so that its edges have the rates at least; cells are
/// halved again and again.
/// @return  in steps of CellCorner
std::array<std::int32_t, 4> longest_sides(const Topology& topology, const Addresses& addresses,
                                          std::span<const Index> rates, Index address);

}  // namespace sublimit
