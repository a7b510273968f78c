// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control meshes of the gallery: the cube of quadrilaterals and cut into triangles in two ways, and the tetrahedron.
// Their points are on one sphere about the origin and have the full symmetry of their solid.
#include <Eigen/Core>

#include <string>
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit::gallery {

struct Cage {
  std::string name;   ///< name in file names: "cube"
  std::string title;  ///< "Cube in triangles"
  Mesh mesh;
};

/// "cube", "cube-tetrahedral" (diagonals are the edges of a tetrahedron, so that its 24 symmetries are left),
/// "cube-irregular" (only one symmetry is left: a triangulation as programs make them), "tetrahedron".
std::vector<Cage> cages();

/// The largest distance of two points, by which distances are divided: the diagonal of a cube, the edge of a
/// tetrahedron.
double diameter(const Points& points);

/// The orthogonal maps (rotations and reflections about the origin) that take a set of points to itself; connectivity
/// is not asked. 48 for the corners of a cube, 24 for those of a regular tetrahedron. The first three points must be
/// linearly independent.
std::vector<Eigen::Matrix3d> symmetries(const Points& points);

}  // namespace sublimit::gallery
