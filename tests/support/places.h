// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places on a limit surface by what they are near to: random ones, on edges, towards vertices.
#include <vector>

#include "sublimit/source/address.h"

namespace sublimit::testing {

/// Multiples of 1/1024 strictly inside random squares (triangles): their neighbours within 1/1024 exist and are exact.
std::vector<Place> random_places(const Addresses& addresses, int count, unsigned seed);

/// (a, b) from the corner of a half-edge, a along it, b along the edge before, in units of the corner's square or
/// triangle. Exact for short binary numbers.
Place from_corner(const Topology& topology, const Addresses& addresses, HalfEdge corner, double a, double b);

/// On an edge, in its face, at s of the way from tail to head.
Place on_edge(const Topology& topology, const Addresses& addresses, HalfEdge edge, double s);

}  // namespace sublimit::testing
