// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rates of edges, from a CSV with the header `v0,v1,rate`: the edge's vertices, from 0 and in either order, and into
// how many segments a tessellation cuts it. Edges that have no row have one segment.
#include <filesystem>
#include <vector>

#include "sublimit/mesh/topology.h"

namespace sublimit {

/// @return  a rate for each edge
/// @throws IoError;  FormatError  with file:line: no edge of the mesh, a rate that is not 1 to 4194304, an edge twice
std::vector<Index> read_edge_rates(const std::filesystem::path& path, const Topology& topology);

}  // namespace sublimit
