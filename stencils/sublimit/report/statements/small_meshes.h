// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes that experiments refine.
#include "sublimit/mesh/control_mesh.h"

namespace sublimit::report {

ControlMesh prism(Index n);           ///< two n-gons, n quads; prism(4) is a cube
ControlMesh torus(Index m, Index n);  ///< quads, all vertices of valence 4
ControlMesh grid(Index m, Index n);   ///< open, m x n quads

}  // namespace sublimit::report
