// SPDX-License-Identifier: Apache-2.0
#pragma once
// Check whether creases of a mesh run along edges of its faces, for readers of tags, before there is a
// topology.
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Returns for each crease whether its vertices are consecutive in some face. Linear time.
/// @pre  face sizes and face vertices are consistent
std::vector<bool> along_edges(const Mesh& mesh, std::span<const Mesh::Crease> creases);

/// Takes out creases where no face has an edge, each with a warning (at most 20).
/// @param place  place(i) is where crease i comes from, "file.obj:7: "
void drop_loose_creases(Mesh& mesh, const std::function<std::string(std::size_t)>& place);

/// Returns the edges of knot intervals as creases, for the lookup.
std::vector<Mesh::Crease> edges_of(std::span<const Mesh::KnotInterval> intervals);

}  // namespace sublimit
