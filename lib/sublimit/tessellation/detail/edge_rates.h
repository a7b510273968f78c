// SPDX-License-Identifier: Apache-2.0
#pragma once
// Segments that edges of a level are to have, and the edges that sides of addresses lie on.
#include <array>
#include <span>

#include "sublimit/source/address.h"

namespace sublimit {

/// @throws InvalidParameter  another number of rates than edges, one below 1 or above 2^22
void check_edge_rates(const Topology& topology, std::span<const Index> rates);

/// The edge along a side of an address: all of it, or as a side of a square of a polygon one half.
struct SideEdge {
  enum class Of { whole, first_half, second_half, none } of = Of::none;  ///< none: inside of a polygon
  Edge edge{};
};
/// Sides counter-clockwise from (0, 0); of triangles three.
std::array<SideEdge, 4> side_edges(const Topology& topology, const Addresses& addresses, Index address);

}  // namespace sublimit
