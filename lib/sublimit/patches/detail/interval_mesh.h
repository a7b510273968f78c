// SPDX-License-Identifier: Apache-2.0
#pragma once
// Conversion of bicubic B-spline surfaces to control meshes with knot intervals, for `catmull-clark-intervals`,
// which allows extraordinary points.
#include <vector>

#include "sublimit/mesh/mesh.h"
#include "sublimit/patches/spline_surface.h"

namespace sublimit {

/// A control mesh with the same limit as a B-spline surface.
struct IntervalMesh {
  /// Quadrilaterals with knot intervals and boundary `none`, counter-clockwise from u to v; no positions. The
  /// outermost faces at open ends only support the limit of the others, and are holes.
  Mesh mesh;
  /// Matrix from the control columns of the surface (three numbers, or four homogeneous ones) to those of the
  /// mesh, u fastest. At open ends knots beyond the domain are spaced like the last two inside.
  SparseMatrix from_points;
  std::vector<Index> faces;  ///< face of the mesh for each face of the surface, with the same parameters
};

/// Returns the control mesh of a surface.
/// @throws InvalidParameter  another degree than 3, a repeated inner knot (an interval of zero), fewer than
///                           three spans in a closed direction; names direction and knot
IntervalMesh interval_mesh(const SplineSurface& surface);

}  // namespace sublimit
