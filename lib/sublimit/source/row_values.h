// SPDX-License-Identifier: Apache-2.0
#pragma once
// Position and derivatives at a place, from rows of weights and the columns of control points, rational or not.
//
//   const CurveStencil stencil = curve.stencil({.segment = 0, .t = 0.5}, 2);
//   const Points own = columns(stencil.unknowns, Eigen::all);
//   const RowValues at = row_values(stencil.weights, 1, own, Coordinates::homogeneous);
//   at.values.row(1);  // the first derivative, by the quotient rule
#include <Eigen/Core>

#include "sublimit/core/types.h"

namespace sublimit {

/// Kind of the columns of control points.
enum class Coordinates {
  plain,        ///< x, y, ..
  homogeneous,  ///< w x, w y, .., w
};

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
