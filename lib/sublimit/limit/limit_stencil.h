// SPDX-License-Identifier: Apache-2.0
#pragma once
// What there is at a place of a surface: weights, or, of given control points, values.
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/limit/limit_status.h"

namespace sublimit {

/// Weights over control vertices of one place.
struct [[nodiscard]] LimitStencil {
  LimitStatus status = LimitStatus::regular;
  std::vector<Index> vertices;  ///< ascending
  /// Rows: position, then du, dv, then duu, duv, dvv, as far as asked for and existing; one column per vertex. Position
  /// weights sum to 1, derivatives' to 0.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> weights;
  /// Two rows along the tangent plane, their cross product along the normal: du and dv where these exist,
  /// characteristic tangents at extraordinary vertices, followed by the next modes, for points that make them
  /// degenerate; none where there is no plane.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> tangents;
};

/// What `evaluate` gives, row by row. Absent quantities are zero; `order` and `status` say what is there; a place
/// outside the domain has the status `outside` and nothing else.
struct [[nodiscard]] LimitSamples {
  Points position;       ///< #samples x 3
  Points du, dv;         ///< order >= 1
  Points duu, duv, dvv;  ///< order 2
  Points normal;         ///< unit length, by the winding of faces, zero where undefined; order >= 1
  std::vector<LimitStatus> status;
  std::vector<std::int8_t> order;  ///< derivatives that this row has: 0, 1 or 2
};

}  // namespace sublimit
