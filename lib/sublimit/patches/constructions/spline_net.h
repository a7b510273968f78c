// SPDX-License-Identifier: Apache-2.0
#pragma once
// Curves and surfaces with their control points, the input and output of constructions. Constructions that are
// B-spline surfaces return the exact net.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sublimit/patches/spline_surface.h"
#include "sublimit/source/rational.h"

namespace sublimit {

/// A B-spline curve with its control points.
struct CurveNet {
  Knots<double> knots;
  Points columns;  ///< a row for each control point
  Coordinates coordinates = Coordinates::plain;
};

/// A B-spline surface with its control points.
struct SplineNet {
  std::shared_ptr<const SplineSurface> surface;
  Points columns;  ///< a row for each control point, u fastest
  Coordinates coordinates = Coordinates::plain;
};

/// A net that depends linearly on data such as control points of curves, the same for each coordinate: net = M
/// * data.
struct NetBuilder {
  std::shared_ptr<const SplineSurface> surface;
  SparseMatrix M;  ///< #points of the net x #rows of the data
};

/// Returns a surface with its control points.
/// @throws InvalidParameter  columns that are not #points x 3, or x 4 if homogeneous
/// @throws ResourceError     more control points than 32-bit indices count
SplineNet spline_net(const Knots<double>& u, const Knots<double>& v, Points columns,
                     Coordinates coordinates = Coordinates::plain);
/// Returns the net of given data.
SplineNet built(const NetBuilder& builder, const Points& data, Coordinates coordinates);

/// Throws unless a curve has finite control points in space.
/// @param name  name of the curve in messages
/// @throws InvalidParameter  another number of control points or columns, or numbers that are not finite
void check_space_curve(const CurveNet& curve, const std::string& name);

/// Returns the curve with homogeneous columns, with weights 1 if it is not rational.
CurveNet homogeneous(CurveNet curve);
/// Makes all curves rational if one of them is.
/// @return  coordinates of all curves
Coordinates make_alike(std::span<CurveNet* const> curves);

/// Returns the columns of a curve at a parameter, or their derivative per unit of the knots.
/// @param order  order of the derivative: 0, 1 or 2
/// @throws InvalidParameter  a parameter outside the domain
Eigen::RowVectorXd column_at(const CurveNet& curve, double t, int order = 0);

/// Returns the largest extent of points, which tolerances are relative to. Homogeneous columns are used as they
/// are.
double extent(std::span<const Points* const> parts);

/// Returns a point as text: "(1, 2.5, 0)".
std::string in_words(const Eigen::RowVectorXd& point);

}  // namespace sublimit
