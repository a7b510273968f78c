// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the Hermite incentre scheme takes: finite points in the plane or in space with tangents of length 1, in curves
// of two points or more whose segments have a length.
#include "sublimit/mesh/control_polygon.h"

namespace sublimit {

/// The polygon with its tangents scaled to units.
/// @throws InvalidMesh, UnsupportedTopology  what is wrong, in which line of the file if there is one
ControlPolygon checked_for_incentres(ControlPolygon polygon);

}  // namespace sublimit
