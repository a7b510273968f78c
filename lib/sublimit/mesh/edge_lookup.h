// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which of a mesh's creases run along edges of its faces: readers of tags ask before any topology exists.
#include <span>
#include <vector>

#include "sublimit/mesh/control_mesh.h"

namespace sublimit {

/// For each crease, whether some face has its two vertices next to each other. Linear time.
/// @pre  sizes of faces fit their vertices
std::vector<bool> along_edges(const ControlMesh& mesh, std::span<const ControlMesh::Crease> creases);

/// The edges of knot intervals, to be looked up like creases.
std::vector<ControlMesh::Crease> edges_of(std::span<const ControlMesh::KnotInterval> intervals);

}  // namespace sublimit
