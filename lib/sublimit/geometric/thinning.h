// SPDX-License-Identifier: Apache-2.0
#pragma once
// Mesh reduction where a surface is nearly flat: refined points of least curvature are merged into a neighbour.
#include "sublimit/geometric/curvature_mesh.h"

namespace sublimit {

/// Returns a mesh reduced to `count` vertices, or as few as possible above that. Vertices are removed by
/// ascending k1^2 + k2^2; each is merged into the neighbour for which the new triangles agree best with the
/// normals of the vertices. Given points (`original`), borders, and the topological type are preserved. No
/// triangle deviates from the normals of its corners by more than 60 degrees unless one around the point did
/// before. Remaining vertices keep their order and the bits of their data.
/// @param mesh  a checked or refined mesh
/// @throws InvalidParameter  count is negative
CurvatureMesh thinned(const CurvatureMesh& mesh, Index count);

}  // namespace sublimit
