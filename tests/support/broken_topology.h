// SPDX-License-Identifier: Apache-2.0
#pragma once
// What makes half-edge arrays a mesh.
#include <string>

#include "sublimit/mesh/topology.h"

namespace sublimit::testing {

/// What is wrong with a topology; empty if all holds: next and prev, twins, edges and their numbers, fans.
std::string broken(const Topology& topology);

/// Vertices - edges + faces, isolated vertices left out.
Index euler_characteristic(const Topology& topology);

/// Half-edges without twin.
Index num_borders(const Topology& topology);

}  // namespace sublimit::testing
