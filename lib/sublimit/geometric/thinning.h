// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fewer points where a surface is nearly flat: the refined points of least curvature are merged into a neighbour.
#include "sublimit/geometric/curvature_mesh.h"

namespace sublimit {

/// A mesh with `count` vertices, or as few as possible above that. Vertices go in the order of k1^2 + k2^2, the least
/// one first, each into the neighbour for which the new triangles come nearest to the vertices' normals. Given points
/// (`original`) and borders stay, and so does the type of the surface; no triangle turns from the normals of its
/// corners by more than 60 degrees unless one around the point did before. Vertices keep their order and their data
/// their bits.
/// @param mesh  checked or refined
/// @throws InvalidParameter  count is negative
CurvatureMesh thinned(const CurvatureMesh& mesh, Index count);

}  // namespace sublimit
