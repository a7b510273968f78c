// SPDX-License-Identifier: Apache-2.0
#pragma once
// Invariants of half-edge arrays.
#include <string>

#include "sublimit/mesh/topology.h"

namespace sublimit::testing {

/// Returns the first violated invariant of a topology (next and prev, twins, edges and their numbers, fans);
/// empty if all hold.
std::string broken(const Topology& topology);

/// Returns vertices - edges + faces, without isolated vertices.
Index euler_characteristic(const Topology& topology);

/// Returns the number of half-edges without a twin.
Index num_borders(const Topology& topology);

}  // namespace sublimit::testing
