// SPDX-License-Identifier: Apache-2.0
#pragma once
// Results of evaluating a surface: the stencil of one place, and the values of many.
//
//   const LimitStencil stencil = surface.map().stencil({.face = 0, .u = 0.5, .v = 0.5}, 1);
//   Eigen::RowVector3d position = Eigen::RowVector3d::Zero();
//   for (size_t i = 0; i < stencil.vertices.size(); ++i)
//     position += stencil.weights(0, Eigen::Index(i)) * surface.points().row(stencil.vertices[i]);
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/source/limit_status.h"

namespace sublimit {

/// The stencil of a place: weights over the control points. Plain data.
struct [[nodiscard]] LimitStencil {
  LimitStatus status = LimitStatus::regular;
  std::vector<Index> vertices;  ///< ascending
  /// Rows for the position, then du, dv, then duu, duv, dvv, as far as asked for and existing; one column per vertex.
  /// The weights of the position sum to 1 up to rounding, those of derivatives to 0.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> weights;
  /// Two rows that span the tangent plane, their cross product along the normal: du and dv if these exist,
  /// characteristic tangents at extraordinary vertices, followed by the next modes, for control points that make the
  /// first two degenerate. No rows if there is no tangent plane.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> tangents;
};

/// Points of a surface with derivatives and normals, a row for each place. Absent quantities are zero; `order` and
/// `status` say what is present; a place outside the domain has the status `outside` and nothing else. Plain data.
struct [[nodiscard]] LimitSamples {
  Points position;                  ///< #places x 3
  Points du, dv;                    ///< first derivatives, if order >= 1
  Points duu, duv, dvv;             ///< second derivatives, if order is 2
  Points normal;                    ///< unit normals by the winding of faces, zero where undefined; if order >= 1
  std::vector<LimitStatus> status;  ///< status of each place
  std::vector<std::int8_t> order;   ///< derivatives that each row has: 0, 1 or 2
};

}  // namespace sublimit
