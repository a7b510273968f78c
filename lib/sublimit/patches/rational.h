// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rational curves and surfaces: the same rows on homogeneous columns (w x, w), and one division at the end. Derivatives
// follow the quotient rule; knots, splits and degrees act on the columns and leave the set as it is.
#include <Eigen/Core>

#include "sublimit/core/types.h"

namespace sublimit {

/// What the columns of control points are.
enum class Coordinates {
  plain,        ///< x, y, ..
  homogeneous,  ///< w x, w y, .., w
};

/// Columns (w x, w) of points with weights. Weights may be negative; a point of weight 0 is a direction ("control
/// vector") and stays (x, 0).
/// @throws InvalidParameter  another number of weights, weights that are not finite or all 0
Points homogeneous(const Points& points, const Eigen::VectorXd& weights);
/// Weights that are not positive: the convex hull property is lost, and there may be poles.
Index num_weights_not_positive(const Points& homogeneous);

/// @throws InvalidParameter  not #points x 3, or x 4 if they are homogeneous
void check_columns(const Points& columns, Index num_points, Coordinates coordinates);

using WeightRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What rows give for control columns.
struct RowValues {
  bool is_pole = false;   ///< w = 0 up to rounding; nothing else is filled
  Points values;          ///< a row for each row
  Eigen::VectorXd sizes;  ///< of each row but the first: what it would be if no terms cancelled
};

/// @param rows       position; of a curve first, second derivative; of a surface du, dv, duu, duv, dvv: as far as
/// wanted
/// @param variables  1 of a curve, 2 of a surface
/// @param columns    as many as rows are wide
/// @param affine     rows of points sum to 1, of derivatives to 0: control points are points, none of them vectors
RowValues row_values(const WeightRows& rows, int variables, Points columns, Coordinates coordinates,
                     bool affine = true);

}  // namespace sublimit
