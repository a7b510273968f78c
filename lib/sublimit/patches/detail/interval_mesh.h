// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bicubic B-spline surfaces as control meshes with knot intervals: the door from NURBS to `catmull-clark-intervals`,
// and so to extraordinary points.
#include <vector>

#include "sublimit/mesh/mesh.h"
#include "sublimit/patches/spline_surface.h"

namespace sublimit {

struct IntervalMesh {
  /// Quadrilaterals with intervals and boundary `none`, counter-clockwise as u turns to v; positions are empty. The
  /// outermost faces beside open ends are support of the others' limit, and holes for that.
  Mesh mesh;
  /// From the surface's control points (columns of three numbers, or four that are homogeneous) to those of the mesh,
  /// u fastest: ends get knots beyond them, as far apart as the last two.
  SparseMatrix from_points;
  std::vector<Index> faces;  ///< of the mesh, for each face of the surface; parameters are the same
};

/// @throws InvalidParameter  naming direction and knot: another degree than 3, a repeated knot inside (an interval of
///                           zero), fewer than three spans around
IntervalMesh interval_mesh(const SplineSurface& surface);

}  // namespace sublimit
