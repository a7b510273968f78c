// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places on a limit surface: random ones, on edges, near vertices.
#include <vector>

#include "sublimit/source/address.h"

namespace sublimit::testing {

/// Returns places at multiples of 1/1024 inside random squares (triangles), so that their neighbours at
/// distance 1/1024 exist and are exact.
std::vector<Place> random_places(const Addresses& addresses, int count, unsigned seed);

/// Returns the place (a, b) from the corner of a half-edge: a along it, b along the edge before, in units of
/// the corner's square or triangle. Exact for short binary numbers.
Place from_corner(const Topology& topology, const Addresses& addresses, HalfEdge corner, double a, double b);

/// Returns the place at parameter s from tail to head on a half-edge, in its face.
Place on_edge(const Topology& topology, const Addresses& addresses, HalfEdge edge, double s);

}  // namespace sublimit::testing
