// SPDX-License-Identifier: Apache-2.0
#pragma once
// Graphs of functions z = f(x,y) that are splines: the control points of x and y are Greville's abscissae.
#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// @param values  control values of f, u fastest, one for each point of the grid
/// @throws InvalidParameter  another number of values; closed knots
SplineNet functional_surface(const Knots<double>& u, const Knots<double>& v, const Eigen::VectorXd& values);

}  // namespace sublimit
