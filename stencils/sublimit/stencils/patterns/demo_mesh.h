// SPDX-License-Identifier: Apache-2.0
#pragma once
// The mesh of `sublimit demo`: a coffee pot, made by revolving a profile and sweeping two tubes. It has the
// features of real control meshes that subdivision must handle: creases that are sharp, semi-sharp and ending,
// an open boundary, a pointed tip, extraordinary vertices, faces with three, five and six corners, a handle.
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Returns a coffee pot on the ground plane y = 0, y up, spout towards +x, handle towards -x; symmetric in z.
///
/// Faces are counter-clockwise seen from outside. One boundary loop (the spout's lip) and one handle: V - E + F = -1.
/// @note  Deterministic; no two vertices coincide, every edge has one or two faces, every vertex one fan of faces.
Mesh demo_mesh();

}  // namespace sublimit
