// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits of curves at places as matrices, whose derivatives are per edge of the control polygon on every level.
#include <vector>

#include "sublimit/curves/detail/curve_layout.h"
#include "sublimit/curves/limit_curve.h"

namespace sublimit::testing {

/// Rows over the unknowns of a level, one for each place.
struct PointLimits {
  SparseMatrix position, first, second;  ///< rows without entries where a derivative does not exist
  std::vector<int> order;                ///< highest derivative that exists: 0 at corners
};

/// Returns the place at a position on the only curve of a level, in half edges (CurveLayout). Positions beyond an end
/// count as the end.
CurvePlace place_at(const CurveLayout& layout, const CurveOutline& curve, std::int64_t position);

/// Returns the limits at places of a level.
PointLimits limits_at(const CurveScheme<double>& scheme, const CurveLevel& level,
                      const std::vector<CurvePlace>& places);
/// Returns the limits at the points of a level.
PointLimits point_limits(const CurveScheme<double>& scheme, const CurveLevel& level);

}  // namespace sublimit::testing
