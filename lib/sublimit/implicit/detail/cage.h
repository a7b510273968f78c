// SPDX-License-Identifier: Apache-2.0
#pragma once
// Quads of a polygoniser made into a control mesh: vertices on the level set, evenly spread, sharp edges of the field
// along edges of the mesh.
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "sublimit/implicit/field.h"
#include "sublimit/mesh/mesh.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

/// A field as smooth surfaces that meet: one for each piece that minima and maxima choose.
class FieldSides {
 public:
  /// @param sharp  whether to tell pieces apart; else the whole field is one side
  FieldSides(FieldPointer field, bool sharp);
  const Field& field() const { return *field_; }
  bool has_edges() const { return sharp_; }
  /// The side that is the surface nearest to a place; always the same one of those that are as near, but for `width`.
  size_t side_at(const Eigen::Vector3d& x, double width) const;
  FieldJet jet(size_t side, const Eigen::Vector3d& x) const;
  /// The place where all of these sides are 0, nearest to x in the sense of Newton's method.
  /// @param reach  how far it may be
  Projection project(std::span<const size_t> sides, const Eigen::Vector3d& x, double reach) const;

 private:
  FieldPointer field_;
  bool sharp_;
};

struct Cage {
  Mesh mesh;                 ///< closed, with tags
  std::vector<size_t> side;  ///< of each face
  double cell = 1;           ///< about how long edges are
  Index rounded = 0;         ///< edges between sides that do not meet there in an angle of more than 10 degrees
};

/// Sides of faces, vertices on them, evenly spread.
/// @param mesh  closed, near to the surface
/// @param cell  of the grid it is from
Cage make_cage(Mesh mesh, const FieldSides& sides, double cell);
/// Every face cut into quads, a triangle into four triangles; vertices on the surface again.
Cage split(const Cage& cage, const FieldSides& sides);
/// Returns a mesh whose quads are cut into triangles along their shorter diagonals.
Cage triangulated(const Cage& cage, const FieldSides& sides);

}  // namespace sublimit
