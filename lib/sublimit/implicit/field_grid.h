// SPDX-License-Identifier: Apache-2.0
#pragma once
// A field sampled over a box of cubes: what polygonisers take. Everything that is wrong with field and box is found
// here.
#include <Eigen/Geometry>

#include <array>
#include <vector>

#include "sublimit/implicit/field.h"

namespace sublimit {

struct FieldGrid {
  Eigen::Vector3d origin;
  double cell = 1;             ///< side of a cube
  std::array<int, 3> size{};   ///< places along x, y, z: cubes and one
  std::vector<double> values;  ///< x fastest
  double least = 0, largest = 0;

  Eigen::Vector3d place(int i, int j, int k) const { return origin + cell * Eigen::Vector3d(i, j, k); }
};

/// A box with a cell of air around {F <= 0}.
/// @param cells  along its longest side, of which two are air
/// @throws InvalidParameter  the field has no extent, or an empty one
Eigen::AlignedBox3d padded_extent(const Field& field, int cells);

/// @param box    in whose middle the cubes lie; they cover it
/// @param cells  along its longest side, 4 or more
/// @throws InvalidParameter  a box without inside; the field is not finite somewhere (the place is told), has one sign
///                           (least and largest value are told, and whether it is thinner than a cell), or is not
///                           positive on the rim of the box (the place is told)
/// @throws ResourceError     more cells than memory holds, before it is taken
FieldGrid sample_field(const Field& field, const Eigen::AlignedBox3d& box, int cells);

}  // namespace sublimit
