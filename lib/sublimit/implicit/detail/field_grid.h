// SPDX-License-Identifier: Apache-2.0
#pragma once
// Samples a field over a box of cubes, as polygonisers take it. All errors of field and box are reported here.
#include <Eigen/Geometry>

#include <array>
#include <vector>

#include "sublimit/implicit/field.h"

namespace sublimit {

/// Values of a field at the corners of cubes. Plain data.
struct FieldGrid {
  Eigen::Vector3d origin;
  double cell = 1;             ///< side of a cube
  std::array<int, 3> size{};   ///< number of values along x, y, z: one more than cubes
  std::vector<double> values;  ///< x fastest
  double least = 0, largest = 0;

  Eigen::Vector3d place(int i, int j, int k) const { return origin + cell * Eigen::Vector3d(i, j, k); }
};

/// Returns a box around {F <= 0} with a margin of one cell.
/// @param cells  number of cells along its longest side, including the margin
/// @throws InvalidParameter  the field has no extent, or an empty one
Eigen::AlignedBox3d padded_extent(const Field& field, int cells);

/// Samples a field.
/// @param box    covered by the cubes, in their middle
/// @param cells  number of cells along its longest side, 4 or more
/// @throws InvalidParameter  a box without inside; a field that is not finite somewhere (says where), has one sign
///                           (gives least and largest value, and says if it is thinner than a cell), or is not
///                           positive on the border of the box (says where)
/// @throws ResourceError     more cells than memory holds, before it is taken
FieldGrid sample_field(const Field& field, const Eigen::AlignedBox3d& box, int cells);

}  // namespace sublimit
