// SPDX-License-Identifier: Apache-2.0
#pragma once
// The level set 0 of a sampled field as quads, by OpenVDB's dual method: a vertex for each cell and sheet of the
// surface. Source: Ju, Losasso, Schaefer, Warren 2002, "Dual contouring of Hermite data" (the mesh); Museth 2013,
// "VDB".
#include "sublimit/implicit/field_grid.h"
#include "sublimit/mesh/control_mesh.h"

namespace sublimit {

/// Quads, closed: counter-clockwise seen from F > 0. Vertices are off the surface
/// by the square of the cells' size, in float.
/// @throws ResourceError  more vertices than 32-bit indices count
ControlMesh polygonize(const FieldGrid& grid);

}  // namespace sublimit
