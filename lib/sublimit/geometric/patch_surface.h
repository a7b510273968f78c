// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes of triangle patches, each determined by the points and normals of its corners, as surfaces that can be
// evaluated anywhere, and as data of finer levels. `Patch` is NielsonPatch<double> or a type with the same
// interface.
#include "sublimit/geometric/normal_mesh.h"
#include "sublimit/geometric/placed_surface.h"

namespace sublimit {

/// Returns the surface of a mesh.
/// @param mesh  checked mesh
template <class Patch>
std::shared_ptr<const PlacedSurface> patch_surface(const NormalMesh& mesh);

/// Returns points and normals of the surface at the vertices of a level, whose triangles are cut into four per
/// step. Given points keep their bits. Vertices are numbered as by refinement. Normals are on the side of the
/// given ones, whatever the winding of faces.
/// @param mesh  checked mesh
/// @throws InvalidParameter  negative `levels`
/// @throws ResourceError     more elements than 32-bit indices, or more memory than the machine has
/// @throws InvalidMesh       a place without a point or normal; names it
template <class Patch>
NormalMesh patch_level(const NormalMesh& mesh, int levels);

/// Returns the common part of both schemes: checks of the data, normals given or estimated, notes.
GeometricNormalScheme patch_scheme(const SchemeOptions& options);

}  // namespace sublimit
