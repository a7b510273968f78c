// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polygonises the level set 0 of a sampled field by OpenVDB's dual method: a vertex for each cell and sheet of the
// surface, a quad for each edge of the grid that the surface crosses. Link sublimit::implicit_mesh.
//
//   const FieldPointer ball = formula_field([](const auto& x) { return squared_norm(x) - 1; });
//   const Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-2), Eigen::Vector3d::Constant(2));
//   write_mesh("ball.obj", polygonize(sample_field(*ball, box, 32)));
//
// Source: Ju, Losasso, Schaefer, Warren 2002, "Dual contouring of Hermite data" (the mesh); Museth 2013, "VDB".
#include "sublimit/implicit/detail/field_grid.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Returns a closed mesh of quads, counter-clockwise seen from F > 0. The distance of its vertices from the surface is
/// of second order in the size of cells; they are computed in float.
/// @throws ResourceError  more vertices than 32-bit indices count
Mesh polygonize(const FieldGrid& grid);

}  // namespace sublimit
