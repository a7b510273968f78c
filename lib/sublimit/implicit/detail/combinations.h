// SPDX-License-Identifier: Apache-2.0
#pragma once
// Combinations of fields: Boolean operations by minima and maxima, with sharp or with smoothed edges; offsets;
// rigid motions and uniform scaling.
#include "sublimit/implicit/detail/primitives.h"

namespace sublimit {

/// Return the union min, the intersection max, and the difference max(a, -b, -c ..) of fields.
/// @throws InvalidParameter  no fields
FieldPointer union_field(std::vector<FieldPointer> fields);
FieldPointer intersection_field(std::vector<FieldPointer> fields);
FieldPointer difference_field(std::vector<FieldPointer> fields);
/// Returns a smooth union, C^1: combines fields one after another by min(a, b) - k h^2 / 4, h = max(1 - |a - b|
/// / k, 0).
/// @param width  k > 0, in the unit of the fields' values
FieldPointer smooth_union_field(std::vector<FieldPointer> fields, double width);
/// Returns F - by. For a distance field its surface is that at this distance, outside if by > 0.
FieldPointer offset_field(FieldPointer field, double by);
/// Returns s F(M^-1 x), where s is the scale of M, so that distance fields remain distance fields.
/// @param matrix  M, from the space of the field to that of the result: a rotation or reflection times a scale
///                > 0 (checked to 1e-9), and a translation
FieldPointer transformed_field(FieldPointer field, const Eigen::Matrix4d& matrix);

}  // namespace sublimit
