// SPDX-License-Identifier: Apache-2.0
#pragma once
// Samples of fields over a box of cubes, the input of polygonisers. Errors of field and box are reported here.
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
/// @throws InvalidParameter  the extent of the field is unknown or empty
Eigen::AlignedBox3d padded_extent(const Field& field, int cells);

/// Returns samples of a field.
/// @param box    box to cover; the cubes are centred on it
/// @param cells  number of cells along its longest side, 4 or more
/// @throws InvalidParameter  an empty box; a field that is not finite somewhere (says where), has one sign only
///                           (names the least and largest value, and whether it is thinner than a cell), or is
///                           not positive on the border of the box (says where)
/// @throws ResourceError     more cells than memory holds; thrown before allocation
FieldGrid sample_field(const Field& field, const Eigen::AlignedBox3d& box, int cells);

}  // namespace sublimit
