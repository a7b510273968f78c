// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control meshes from the quads of a polygoniser: vertices lie on the level set, evenly spread, and sharp edges
// of the field run along edges of the mesh.
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "sublimit/implicit/field.h"
#include "sublimit/mesh/mesh.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

/// A field as several smooth surfaces (sides) that meet: one for each argument that minima and maxima may
/// select.
class FieldSides {
 public:
  /// @param sharp  true: distinguish the arguments of minima and maxima; false: the whole field is one side
  FieldSides(FieldPointer field, bool sharp);
  const Field& field() const { return *field_; }
  bool has_edges() const { return sharp_; }
  /// Returns the side whose surface is nearest to a place. Among sides that are equally near up to `width` the
  /// choice is always the same.
  size_t side_at(const Eigen::Vector3d& x, double width) const;
  /// Returns value and derivatives of a side.
  FieldJet jet(size_t side, const Eigen::Vector3d& x) const;
  /// Returns a place near x where all given sides are 0, by Newton's method.
  /// @param reach  largest distance from x
  Projection project(std::span<const size_t> sides, const Eigen::Vector3d& x, double reach) const;

 private:
  FieldPointer field_;
  bool sharp_;
};

/// A control mesh near a level set.
struct Cage {
  Mesh mesh;                 ///< closed mesh with tags
  std::vector<size_t> side;  ///< side of each face
  double cell = 1;           ///< approximate length of edges
  Index rounded = 0;         ///< number of edges between sides that meet in an angle of at most 10 degrees
};

/// Returns a cage: assigns sides to faces, projects vertices onto them, and spreads these evenly.
/// @param mesh  closed mesh near the surface
/// @param cell  cell size of the grid that the mesh is from
Cage make_cage(Mesh mesh, const FieldSides& sides, double cell);
/// Returns a cage with every face cut into quads, or triangles into four triangles, and vertices projected onto
/// the surface.
Cage split(const Cage& cage, const FieldSides& sides);
/// Returns a mesh whose quads are cut into triangles along their shorter diagonals.
Cage triangulated(const Cage& cage, const FieldSides& sides);

}  // namespace sublimit
