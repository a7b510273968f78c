// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bezier cells as an unstructured grid of VTK (`.vtu`), which ParaView draws as curved:
// VTK_BEZIER_QUADRILATERAL (77) and VTK_BEZIER_TRIANGLE (76). Data of cells:
//
//   HigherOrderDegrees  of u, v and nothing; of triangles the total degree
//   face                square or triangle of the surface, as `sublimit sample` numbers them
//   control_face        of the mesh
//   corners             u, v in that face of the cell's (0, 0), (1, 0), (1, 1), (0, 1), of triangles (0, 0), (1, 0),
//   (0, 1), (0, 1) exact               1: a polynomial of the surface; 0: bilinear, near it
//
// All weights are 1, so RationalWeights are left out. Source: VTK 9, vtkBezierQuadrilateral, vtkHigherOrderTriangle.
#include <cstdint>
#include <filesystem>
#include <functional>

#include "sublimit/tessellation/detail/bezier_cells.h"

namespace sublimit {

/// Returns the control points of a net in VTK's order, as rows of the net, in which j runs fastest: corners,
/// sides counter-clockwise, then the inside. Sides of squares run along u and v, those of triangles from corner
/// to corner; the inside of a triangle is ordered as a triangle again.
std::vector<Eigen::Index> vtk_order(int degree, bool triangle);

/// Writes cells.
/// @throws InvalidMesh  a coordinate that is not finite;  IoError  unwritable;  ResourceError  a full disk
void write_vtu(const std::filesystem::path& path, const BezierCells& cells, const Addresses& addresses,
               const std::function<void(std::int64_t)>& progress = {});

}  // namespace sublimit
