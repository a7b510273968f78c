// SPDX-License-Identifier: Apache-2.0
#pragma once
// Normals where control points make the tangents parallel or zero: the modes that decay next decide, if they
// span a plane together with the tangents.
#include <Eigen/Core>

#include <vector>

namespace sublimit {

/// Returns the normal of the plane that degenerate tangents and the next modes span.
/// @param t1, t2     tangents, parallel or zero
/// @param higher     vectors of the next modes
/// @param scale      length that the tangents would have if their terms did not cancel
/// @param turn_area  sum of the cross products of the edges of the faces around the place (twice the area
///                   vector of the faces); decides the sign of the normal
/// @return  unit length; zero if the vectors do not span a plane or the sign is undecided
Eigen::Vector3d degenerate_normal(const Eigen::Vector3d& t1, const Eigen::Vector3d& t2,
                                  const std::vector<Eigen::Vector3d>& higher, double scale,
                                  const Eigen::Vector3d& turn_area);

}  // namespace sublimit
