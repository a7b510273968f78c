// SPDX-License-Identifier: Apache-2.0
#pragma once
// Curves and surfaces with their control points: what constructions take, and what they make. A construction that is a
// B-spline surface gives the exact net of it.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sublimit/patches/rational.h"
#include "sublimit/patches/spline_surface.h"

namespace sublimit {

struct CurveNet {
  Knots<double> knots;
  Points columns;  ///< a row for each control point
  Coordinates coordinates = Coordinates::plain;
};

struct SplineNet {
  std::shared_ptr<const SplineSurface> surface;
  Points columns;  ///< a row for each control point, u fastest
  Coordinates coordinates = Coordinates::plain;
};

/// A net that is linear in control points of curves, the same for each coordinate: net = M * data.
struct NetBuilder {
  std::shared_ptr<const SplineSurface> surface;
  SparseMatrix M;  ///< #points of the net x #rows of the data
};

/// @throws InvalidParameter  columns that are not one for each control point, x 3, or x 4 if they are homogeneous
/// @throws ResourceError     more control points than 32-bit indices count
SplineNet spline_net(const Knots<double>& u, const Knots<double>& v, Points columns,
                     Coordinates coordinates = Coordinates::plain);
SplineNet built(const NetBuilder& builder, const Points& data, Coordinates coordinates);

/// @param name  of the curve in messages
/// @throws InvalidParameter  columns that are not one for each control point, of another width, not finite
void check_space_curve(const CurveNet& curve, const std::string& name);

/// Returns the curve with homogeneous columns: (x, 1) if it is not rational.
CurveNet homogeneous(CurveNet curve);
/// Makes all nets rational if one of them is.
/// @return  what they are then
Coordinates make_alike(std::span<CurveNet* const> curves);

/// Sum of rows times columns at a parameter: the derivative of some order of the columns, per unit of the knots.
/// @param order  0, 1 or 2
/// @throws InvalidParameter  outside the domain
Eigen::RowVectorXd column_at(const CurveNet& curve, double t, int order = 0);

/// The largest extent of points, as measure of what is small beside them; columns of rational ones are taken as they
/// are.
double extent(std::span<const Points* const> parts);

/// "(1, 2.5, 0)"
std::string in_words(const Eigen::RowVectorXd& point);

}  // namespace sublimit
