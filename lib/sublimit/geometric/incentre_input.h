// SPDX-License-Identifier: Apache-2.0
#pragma once
// Input check of the Hermite incentre scheme. It needs finite points in the plane or in space with unit
// tangents, in curves of at least two points without segments of length 0.
#include "sublimit/mesh/control_polygon.h"

namespace sublimit {

/// Returns the polygon with unit tangents.
/// @throws InvalidMesh, UnsupportedTopology  unsuitable input; names the line of the file if there is one
ControlPolygon checked_for_incentres(ControlPolygon polygon);

}  // namespace sublimit
