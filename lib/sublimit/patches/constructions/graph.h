// SPDX-License-Identifier: Apache-2.0
#pragma once
// Graphs of spline functions z = f(x,y): the x and y of control points are Greville abscissae.
#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// Returns the graph as a surface.
/// @param values  control values of f, u fastest, one for each point of the grid
/// @throws InvalidParameter  another number of values; closed knots
SplineNet functional_surface(const Knots<double>& u, const Knots<double>& v, const Eigen::VectorXd& values);

}  // namespace sublimit
