// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rational curves and surfaces: the weights of polynomial ones applied to homogeneous columns (w x, w), and one
// division at the end. Derivatives follow the quotient rule; changes of knots and degrees act on the columns.
//
//   const Points corners{{1, 0}, {1, 1}, {0, 1}};
//   const Points columns = homogeneous(corners, Eigen::Vector3d(1, std::sqrt(0.5), 1));  // a quarter of a circle
//   const SplineCurve arc(bezier_knots<double>(2));
//   const std::vector<CurvePlace> middle = {{.segment = 0, .t = 0.5}};
//   const CurveSamples samples = arc.evaluate(columns, middle, 2, Coordinates::homogeneous);
#include <Eigen/Core>

#include "sublimit/core/types.h"

namespace sublimit {

/// Kind of the columns of control points.
enum class Coordinates {
  plain,        ///< x, y, ..
  homogeneous,  ///< w x, w y, .., w
};

/// Returns the columns (w x, w) of points with weights. Weights may be negative; a point of weight 0 is a direction
/// ("control vector") and becomes (x, 0).
/// @param points   #points x dimension
/// @param weights  #points
/// @throws InvalidParameter  another number of weights, weights that are not finite or all 0
Points homogeneous(const Points& points, const Eigen::VectorXd& weights);
/// Returns how many weights are not positive. If there are any, the convex hull property is lost, and there may be
/// poles.
Index num_weights_not_positive(const Points& homogeneous);

/// Returns the control points in space: (w x, w) divided by w, and without directions, whose w is 0.
/// @param columns  #points x 3, or x 4 if they are homogeneous
Points points_in_space(const Points& columns);

/// Throws unless columns are those of control points of a surface.
/// @throws InvalidParameter  columns that are not #points x 3, or x 4 if they are homogeneous
void check_columns(const Points& columns, Index num_points, Coordinates coordinates);

/// Weights row by row: position, then derivatives.
using WeightRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Position and derivatives at a place.
struct RowValues {
  bool is_pole = false;   ///< w = 0 up to rounding; nothing else is filled
  Points values;          ///< position or derivative for each row of weights
  Eigen::VectorXd sizes;  ///< for each derivative: its size if no terms cancelled, a scale of rounding errors
};

/// Returns position and derivatives from weights and control columns.
/// @param rows       weights of the position, then first and second derivative of a curve, or du, dv, duu, duv, dvv
///                   of a surface, as far as wanted
/// @param variables  1 for a curve, 2 for a surface
/// @param columns    control columns, one for each column of `rows`
/// @param affine     true if all control points are points: weights of positions sum to 1, those of derivatives to 0
RowValues row_values(const WeightRows& rows, int variables, Points columns, Coordinates coordinates,
                     bool affine = true);

}  // namespace sublimit
