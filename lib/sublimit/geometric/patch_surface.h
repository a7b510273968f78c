// SPDX-License-Identifier: Apache-2.0
#pragma once
// A mesh of triangle patches, each made of nothing but the points and normals of its corners, as a surface that can be
// evaluated anywhere, and as data of finer levels. `Patch` is NielsonPatch<double> or one like it.
#include "sublimit/geometric/normal_mesh.h"
#include "sublimit/geometric/placed_surface.h"

namespace sublimit {

/// @param mesh  checked
template <class Patch>
std::shared_ptr<const PlacedSurface> patch_surface(const NormalMesh& mesh);

/// Points of the surface with its normals: those of a level of triangles cut in four, old ones bitwise as they were.
/// Vertices are numbered as by refinement. Normals are on the side of the data's, whatever way faces are wound.
/// @param mesh  checked
/// @throws InvalidParameter  negative `levels`
/// @throws ResourceError     more elements than 32-bit indices, or more memory than the machine has
/// @throws InvalidMesh       a place without a point or a normal, naming it
template <class Patch>
NormalMesh patch_level(const NormalMesh& mesh, int levels);

/// Returns the common part of both schemes: checks of the data, normals given or estimated, notes.
GeometricNormalScheme patch_scheme(const SchemeOptions& options);

}  // namespace sublimit
