// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control meshes of the gallery: the cube of quadrilaterals, the cube cut into triangles in two ways, the
// tetrahedron. The points of each are on a sphere about the origin and have the full symmetry of the solid.
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

/// Returns "cube", "cube-tetrahedral" (diagonals are the edges of a tetrahedron, which leaves its 24
/// symmetries), "cube-irregular" (a triangulation as programs make them, which leaves one symmetry), and
/// "tetrahedron".
std::vector<Cage> cages();

/// Returns the largest distance of two points, to which distances are relative: the diagonal of a cube, the
/// edge of a tetrahedron.
double diameter(const Points& points);

/// Returns the orthogonal maps (rotations and reflections about the origin) that map a set of points to itself,
/// without regard to connectivity: 48 for the corners of a cube, 24 for those of a regular tetrahedron. The
/// first three points must be linearly independent.
std::vector<Eigen::Matrix3d> symmetries(const Points& points);

}  // namespace sublimit::gallery
