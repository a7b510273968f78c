// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rates of edges for tessellations, from a CSV with the header `v0,v1,rate`: the vertices of an edge, counted
// from 0 and in either order, and the number of its segments. Edges without a row have one segment.
#include <filesystem>
#include <vector>

#include "sublimit/mesh/topology.h"

namespace sublimit {

/// Reads the rates of all edges of a mesh.
/// @return  rate of each edge
/// @throws IoError      missing, unreadable
/// @throws FormatError  not an edge of the mesh, a rate outside 1 to 4194304, an edge twice; the message has
///                      file and line
std::vector<Index> read_edge_rates(const std::filesystem::path& path, const Topology& topology);

}  // namespace sublimit
