// SPDX-License-Identifier: Apache-2.0
#pragma once
// The curves and points of a recipe that a surface of the gallery was made from, and their places on the surface.
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/stencils/json/json_value.h"

namespace sublimit::gallery {

struct PatchData {
  std::vector<Points> curves;  ///< points along each curve
  Points points;               ///< points that the surface interpolates, #x3
  Points normals;              ///< normals at these points; no rows if there are none
};

/// Returns the data of a recipe.
/// @param recipe  a recipe of the gallery (patches.json): profiles are in the plane of x and z, paths end in
///                their first and last control points, curves that are translated begin at the origin
/// @throws FormatError  as the readers of recipes
PatchData patch_data(const JsonValue& recipe);

}  // namespace sublimit::gallery
