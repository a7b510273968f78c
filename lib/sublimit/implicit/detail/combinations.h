// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fields of fields: Boolean operations by minima and maxima, with sharp edges where arguments tie or smooth ones;
// offsets; rigid motions and uniform scale.
#include "sublimit/implicit/detail/primitives.h"

namespace sublimit {

/// min, max, max(a, -b, -c ..). @throws InvalidParameter  no fields
FieldPointer union_field(std::vector<FieldPointer> fields);
FieldPointer intersection_field(std::vector<FieldPointer> fields);
FieldPointer difference_field(std::vector<FieldPointer> fields);
/// One after the other min(a, b) - k h^2 / 4, h = max(1 - |a - b| / k, 0): C^1.
/// @param width  k > 0, in the unit of the fields' values
FieldPointer smooth_union_field(std::vector<FieldPointer> fields, double width);
/// F - by: of a distance field the surface at that distance, outside if by > 0.
FieldPointer offset_field(FieldPointer field, double by);
/// s F(M^-1 x), s the scale of M: what is a distance stays one.
/// @param matrix  M, maps the field's space to this one: rotation or reflection times a scale > 0, and translation, to
///                1e-9
FieldPointer transformed_field(FieldPointer field, const Eigen::Matrix4d& matrix);

}  // namespace sublimit
