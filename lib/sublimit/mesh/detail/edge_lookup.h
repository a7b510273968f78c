// SPDX-License-Identifier: Apache-2.0
#pragma once
// Check whether creases of a mesh run along edges of its faces, for readers of tags, before there is a
// topology.
#include <span>
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Returns for each crease whether its vertices are consecutive in some face. Linear time.
/// @pre  face sizes and face vertices are consistent
std::vector<bool> along_edges(const Mesh& mesh, std::span<const Mesh::Crease> creases);

/// Returns the edges of knot intervals as creases, for the lookup.
std::vector<Mesh::Crease> edges_of(std::span<const Mesh::KnotInterval> intervals);

}  // namespace sublimit
