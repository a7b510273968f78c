// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which of a mesh's creases run along edges of its faces: readers of tags ask before any topology exists.
#include <span>
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// For each crease, whether some face has its two vertices next to each other. Linear time.
/// @pre  sizes of faces fit their vertices
std::vector<bool> along_edges(const Mesh& mesh, std::span<const Mesh::Crease> creases);

/// The edges of knot intervals, to be looked up like creases.
std::vector<Mesh::Crease> edges_of(std::span<const Mesh::KnotInterval> intervals);

}  // namespace sublimit
