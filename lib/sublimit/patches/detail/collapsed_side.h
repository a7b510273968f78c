// SPDX-License-Identifier: Apache-2.0
#pragma once
// Normals where a whole side of a surface is one point: S_u = 0 along v = v_0. Inside near it S_u is (v - v_0) S_uv, so
// along each curve of constant u the normal tends to that of S_uv x S_v. A plane exists if all S_v(u, v_0) lie in it
// and turn once, at most: a pole of a sphere, not the apex of a cone.
#include <Eigen/Core>

#include "sublimit/patches/spline_surface.h"

namespace sublimit {

/// Returns the normal at a place on a collapsed side.
/// @return  unit length; zero if the place is on no collapsed side, or there is no tangent plane
Eigen::Vector3d collapsed_side_normal(const SplineSurface& surface, const Points& columns, Coordinates coordinates,
                                      const Place& place);

}  // namespace sublimit
