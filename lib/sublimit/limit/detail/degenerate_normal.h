// SPDX-License-Identifier: Apache-2.0
#pragma once
// Normals where control points make the tangents degenerate: the modes that decay next decide, if they span a plane
// with them.
#include <Eigen/Core>

#include <vector>

namespace sublimit {

/// @param t1, t2     tangents that are parallel, or zero
/// @param higher     what the next modes add to them
/// @param scale      length of the tangents if nothing cancelled
/// @param turn_area  how the faces turn around the place, twice the area that they sweep: tells the sides of a plane
/// apart
/// @return  unit length, or zero if they do not settle it
Eigen::Vector3d degenerate_normal(const Eigen::Vector3d& t1, const Eigen::Vector3d& t2,
                                  const std::vector<Eigen::Vector3d>& higher, double scale,
                                  const Eigen::Vector3d& turn_area);

}  // namespace sublimit
