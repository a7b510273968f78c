// SPDX-License-Identifier: Apache-2.0
#pragma once
// Derivatives of a limit curve at a point around which refinement repeats itself: a point of a primal scheme, the
// middle of an edge of a dual one, or an end of the limit. The unknowns around it refine to themselves by a local
// matrix A, read off S. The first derivative is the left eigenvector of A for 1/2, the second the one for 1/4, scaled
// by the parameters of the points. Other places are descended to such points by CurvePieces.
#include <Eigen/Core>

#include <array>
#include <vector>

#include "sublimit/curves/detail/curve_levels.h"

namespace sublimit {

/// Unknown that a row or column of a local matrix stands for.
struct CurveUnknown {
  std::int64_t position;  ///< in half edges from the vertex
  int component = 0;      ///< 0 for the point, 1 for the derivative at it (Hermite schemes)
  Index column = 0;       ///< number of the unknown on its curve
};

/// Unknowns around a vertex that depend on no others: one refinement step takes their values x to A x.
struct CurveNeighborhood {
  std::vector<CurveUnknown> unknowns;  ///< unknowns of the rows and columns of A, by ascending position
  Eigen::MatrixXd A;
};

/// Number of half edges by which a neighbourhood may exceed the radius of the masks: second differences out there
/// identify the parabola.
inline constexpr int curve_margin = 10;

/// Returns the neighbourhood of a vertex.
/// @param curve   an open curve of `level`, so long that no end but one at the vertex itself matters
/// @param vertex  even position on the curve (CurveLayout), or that of the limit's start or end
/// @param margin  half edges by which the neighbourhood is larger than the radius of the masks
CurveNeighborhood curve_neighborhood(const CurveScheme<double>& scheme, const CurveOutline& curve, int level,
                                     std::int64_t vertex, int margin = 0);

/// Derivatives at a vertex per edge of the level, as rows over the unknowns of the curve.
struct CurveVertex {
  bool has_first = false;
  std::array<bool, 2> has_second{false, false};  ///< one-sided ones, before and behind the vertex; equal at an end
  Eigen::RowVectorXd first;
  std::array<Eigen::RowVectorXd, 2> second;

  /// Returns the highest derivative that exists: 2 only if both one-sided second derivatives agree.
  int order() const;
};

/// Returns the derivatives at a vertex, as `curve_neighborhood`. Second ones of Hermite schemes are not looked for.
/// @param level  one from which on the masks stay the same
CurveVertex curve_vertex(const CurveScheme<double>& scheme, const CurveOutline& curve, int level, std::int64_t vertex);

}  // namespace sublimit
