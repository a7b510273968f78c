// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/detail/edge_rates.h"

#include <bit>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/nets/piece_parts.h"

namespace sublimit {

void check_edge_rates(const Topology& topology, std::span<const Index> rates) {
  constexpr Index most_segments = 1 << 22;
  if (std::ssize(rates) != topology.num_edges())
    throw InvalidParameter(std::to_string(rates.size()) + " rates; one for each of " +
                           std::to_string(topology.num_edges()) + " edges is right");
  for (const Index rate : rates)
    if (rate < 1 || rate > most_segments)
      throw InvalidParameter("a rate is " + std::to_string(rate) + "; 1 to 4194304 segments is right");
}

std::array<SideEdge, 4> side_edges(const Topology& topology, const Addresses& addresses, Index address) {
  const Addresses::FaceCorner place = addresses.place(address);
  std::array<SideEdge, 4> sides;
  if (place.corner < 0) {
    for (Index k = 0; k < (addresses.triangles() ? 3 : 4); ++k)
      sides[size_t(k)] = {SideEdge::Of::whole, topology.edge(topology.corner(place.face, k))};
    return sides;
  }
  const HalfEdge h = topology.corner(place.face, place.corner);
  sides[0] = {SideEdge::Of::first_half, topology.edge(h)};
  sides[3] = {SideEdge::Of::second_half, topology.edge(topology.prev(h))};
  return sides;
}

std::array<std::int32_t, 4> longest_sides(const Topology& topology, const Addresses& addresses,
                                          std::span<const Index> rates, Index address) {
  const std::array<SideEdge, 4> edges = side_edges(topology, addresses, address);
  std::array<std::int32_t, 4> longest{};
  for (size_t k = 0; k < edges.size(); ++k) {
    const auto [of, edge] = edges[k];
    const Index rate = of == SideEdge::Of::none ? 1 : rates[size_t(index(edge))];
    const Index segments = of == SideEdge::Of::whole ? rate : (rate + 1) / 2;
    longest[k] = static_cast<std::int32_t>(cell_steps / std::int64_t(std::bit_ceil(unsigned(segments))));
  }
  return longest;
}

}  // namespace sublimit
